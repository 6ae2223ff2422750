// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include <cmath>
#include <fstream>
#include <limits>
#include <map>
#include <stdexcept>

#include "lidar_upsampling/objects/detector.h"
#include "lidar_upsampling/text.h"

namespace lidar_upsampling {
namespace {

constexpr const char* kBlanks = " \t\r\"";

double parse_number(const std::string& text, const char* column) {
  if (const auto number = number_in(text)) return *number;
  throw std::invalid_argument(std::string(column) + " is '" + text + "', not a number");
}

Detection parse_detection(const std::vector<std::string>& fields) {
  Detection detection;
  detection.class_name = fields[2];
  detection.score = fields[3].empty() ? 1. : parse_number(fields[3], "score");
  detection.box = {parse_number(fields[4], "left"), parse_number(fields[5], "top"),
                   parse_number(fields[6], "right"), parse_number(fields[7], "bottom")};
  if (detection.box.width() <= 0 || detection.box.height() <= 0) {
    throw std::invalid_argument("the box is empty: right and bottom must exceed left and top");
  }
  if (fields.size() == 9 && !fields[8].empty()) {
    const double track = parse_number(fields[8], "track");
    if (track < -1 || track > std::numeric_limits<int>::max() || track != std::floor(track)) {
      throw std::invalid_argument("track is '" + fields[8] + "', not a whole number");
    }
    detection.external_track = static_cast<int>(track);
  }
  return detection;
}

class CsvDetector : public Detector {
 public:
  explicit CsvDetector(const CsvDetectorOptions& options)
      : tolerance_s_(1e-3 * options.stamp_tolerance_ms) {
    std::ifstream file(options.path);
    if (!file) {
      throw std::runtime_error("cannot read the detections file '" + options.path +
                               "' (detector.csv: does it exist?)");
    }
    std::size_t number = 1;
    try {
      for (std::string line; next_line(file, line); ++number) take_line(line, number == 1);
    } catch (const std::invalid_argument& error) {
      throw std::runtime_error(options.path + ", line " + std::to_string(number) + ": " +
                               error.what() +
                               "; expected label,stamp,class,score,left,top,right,bottom[,track]");
    }
    if (file.bad()) throw std::runtime_error("reading '" + options.path + "' failed");
  }

  std::vector<Detection> detect(const CameraImage& image) override {
    const auto found = boxes_.find(image.camera.label);
    if (found == boxes_.end()) return {};
    const auto& by_stamp = found->second;
    const Stamp stamp = image.stamp;
    auto nearest = by_stamp.lower_bound(stamp);
    if (nearest != by_stamp.begin()) {
      const auto before = std::prev(nearest);
      if (nearest == by_stamp.end() || stamp - before->first <= nearest->first - stamp) {
        nearest = before;
      }
    }
    if (std::abs(seconds_between(stamp, nearest->first)) > tolerance_s_) return {};
    return nearest->second;
  }

 private:
  void take_line(const std::string& line, bool is_first) {
    const std::vector<std::string> fields = comma_separated(line, kBlanks);
    const bool blank = trimmed(line, kBlanks).empty() || fields[0].rfind('#', 0) == 0;
    const bool header = is_first && fields.size() > 1 && fields[1] == "stamp";
    if (blank || header) return;
    if (fields.size() < 8 || fields.size() > 9)
      throw std::invalid_argument(std::to_string(fields.size()) + " columns");
    boxes_[fields[0]][parse_stamp(fields[1])].push_back(parse_detection(fields));
  }

  double tolerance_s_;
  std::map<std::string, std::map<Stamp, std::vector<Detection>>> boxes_;  // by label
};

}  // namespace

std::unique_ptr<Detector> make_csv_detector(const CsvDetectorOptions& options) {
  return std::make_unique<CsvDetector>(options);
}

std::unique_ptr<Detector> make_detector(const DetectorOptions& options) {
  if (options.type == DetectorOptions::Type::network) return make_network_detector(options.network);
  if (options.type == DetectorOptions::Type::csv) return make_csv_detector(options.csv);
  return nullptr;
}

}  // namespace lidar_upsampling
