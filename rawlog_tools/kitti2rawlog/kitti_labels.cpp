// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "kitti2rawlog/kitti_labels.h"

#include <charconv>
#include <cmath>
#include <optional>
#include <set>
#include <sstream>
#include <stdexcept>
#include <utility>

#include "import/input_file.h"

namespace lidar_upsampling::kitti {
namespace {

constexpr std::size_t kColumns = 17;  // one more in files of results: a score

// A line of a label file, and the file's name for what is wrong with it.
class LabelLine {
 public:
  LabelLine(const std::string& path, std::size_t number, const std::string& line)
      : path_(path), number_(number) {
    std::istringstream in(line);
    for (std::string word; in >> word;) words_.push_back(word);
    if (words_.size() == kColumns || words_.size() == kColumns + 1) return;
    std::string what = std::to_string(words_.size()) + " columns instead of " +
                       std::to_string(kColumns) +
                       " (frame track type truncated occluded alpha "
                       "left top right bottom height width length x y z rotation_y)";
    // Those of single pictures lack the first two.
    if (words_.size() == kColumns - 2) what += ": a label of the object benchmark (label_2)?";
    fail(what);
  }

  [[nodiscard]] const std::string& word(std::size_t column) const { return words_[column]; }

  [[nodiscard]] int integer(std::size_t column) const {
    return parsed<int>(column, "no whole number");
  }
  [[nodiscard]] double number(std::size_t column) const {
    const double value = parsed<double>(column, "no number");
    if (!std::isfinite(value)) fail("'" + words_[column] + "' is no number");
    return value;
  }

  [[noreturn]] void fail(const std::string& what) const {
    throw std::runtime_error(path_ + ", line " + std::to_string(number_) + ": " + what);
  }

 private:
  template <typename Number>
  [[nodiscard]] Number parsed(std::size_t column, const std::string& otherwise) const {
    const std::string& text = words_[column];
    const char* const end = text.data() + text.size();
    Number value{};
    const auto [rest, error] = std::from_chars(text.data(), end, value);
    if (error != std::errc() || rest != end) fail("'" + text + "' is " + otherwise);
    return value;
  }

  const std::string& path_;
  std::size_t number_;
  std::vector<std::string> words_;
};

// The label's point is in the middle of the box's bottom, the camera's axis Y points down.
Pose T_rectified_0_object(const LabelLine& line, double height) {
  Pose T(Eigen::Translation3d(line.number(13), line.number(14) - 0.5 * height, line.number(15)));
  T.rotate(Eigen::AngleAxisd(line.number(16), Eigen::Vector3d::UnitY()));
  Eigen::Matrix3d forward_left_up;
  forward_left_up << 1, 0, 0, 0, 0, -1, 0, 1, 0;
  T.linear() *= forward_left_up;
  return T;
}

LabelRow row_from(const LabelLine& line) {
  LabelRow row;
  row.frame = line.integer(0);
  row.track = line.integer(1);
  row.type = line.word(2);
  row.box = {line.number(6), line.number(7), line.number(8), line.number(9)};
  if (row.is_ignored_area()) return row;
  row.size = {line.number(12), line.number(11), line.number(10)};
  if (!(row.size.minCoeff() > 0)) {
    line.fail("a box without extent: height width length " + line.word(10) + " " + line.word(11) +
              " " + line.word(12));
  }
  row.T_rectified_0_object = T_rectified_0_object(line, row.size.z());
  return row;
}

}  // namespace

std::vector<LabelRow> read_labels(const std::string& path) {
  std::ifstream in = importing::open_file(path);
  if (!in) throw std::runtime_error("cannot read the labels " + path);
  std::vector<LabelRow> rows;
  std::set<std::pair<int, int>> seen;
  std::size_t number = 0;
  for (std::string text; std::getline(in, text);) {
    ++number;
    if (text.find_first_not_of(" \t\r") == std::string::npos) continue;
    const LabelLine line(path, number, text);
    rows.push_back(row_from(line));
    const LabelRow& row = rows.back();
    if (!row.is_ignored_area() && !seen.emplace(row.track, row.frame).second) {
      line.fail("track " + std::to_string(row.track) + " is already labelled in frame " +
                std::to_string(row.frame));
    }
  }
  if (rows.empty()) throw std::runtime_error(path + " holds no labels");
  return rows;
}

}  // namespace lidar_upsampling::kitti
