// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include <algorithm>
#include <fstream>
#include <opencv2/dnn.hpp>
#include <opencv2/imgproc.hpp>
#include <stdexcept>

#include "lidar_upsampling/objects/detector.h"
#include "lidar_upsampling/objects/network_output.h"

namespace lidar_upsampling {
namespace {

constexpr int kDefaultInputSize =
    640;                           ///< of the ONNX families; cv::dnn does not tell a model's own
constexpr int kPaddingGray = 114;  ///< what the ONNX families are trained with

[[noreturn]] void fail(const std::string& what) {
  throw std::runtime_error("network detector: " + what);
}

bool ends_with(const std::string& text, const std::string& ending) {
  return text.size() >= ending.size() &&
         text.compare(text.size() - ending.size(), ending.size(), ending) == 0;
}

void check_readable(const std::string& path, const char* setting) {
  if (path.empty()) fail(std::string("no ") + setting + " file set");
  if (!std::ifstream(path))
    fail("cannot read the " + std::string(setting) + " file '" + path + "'");
}

std::vector<std::string> load_lines(const std::string& path) {
  std::ifstream file(path);
  std::vector<std::string> lines;
  for (std::string line; std::getline(file, line);) {
    line.erase(line.find_last_not_of(" \t\r") + 1);
    if (!line.empty()) lines.push_back(line);
  }
  return lines;
}

/// A class goes by other names in other lists of the same 80 classes.
std::string canonical(std::string name) {
  std::replace(name.begin(), name.end(), ' ', '_');
  return name == "motorcycle" ? "motorbike" : name;
}

std::vector<bool> find_wanted(const std::vector<std::string>& wanted,
                              const std::vector<std::string>& known) {
  std::vector<bool> is_wanted(known.size(), wanted.empty());
  for (const std::string& name : wanted) {
    const auto found = std::find_if(known.begin(), known.end(), [&](const std::string& other) {
      return canonical(other) == canonical(name);
    });
    if (found == known.end()) {
      throw std::invalid_argument("network detector: class '" + name +
                                  "' is not in the class names file");
    }
    is_wanted[found - known.begin()] = true;
  }
  return is_wanted;
}

/// The value of `key=` in a Darknet .cfg, 0 without.
int darknet_value(const std::string& path, const std::string& key) {
  for (const std::string& line : load_lines(path)) {
    if (line.rfind(key, 0) != 0) continue;
    const auto digits = line.find_first_of("0123456789");
    if (digits != std::string::npos) return std::stoi(line.substr(digits));
  }
  return 0;
}

cv::dnn::Net load_net(const NetworkDetectorOptions& options) {
  check_readable(options.model, "model");
  check_readable(options.classes, "class names");
  try {
    if (ends_with(options.model, ".onnx")) return cv::dnn::readNetFromONNX(options.model);
    check_readable(options.config, "config (.cfg)");
    return cv::dnn::readNetFromDarknet(options.config, options.model);
  } catch (const cv::Exception& error) {
    fail("OpenCV cannot load '" + options.model + "': " + error.what());
  }
}

cv::Size input_size(const NetworkDetectorOptions& options) {
  if (options.input_width > 0 && options.input_height > 0) {
    return {options.input_width, options.input_height};
  }
  if (!options.config.empty()) {
    return {darknet_value(options.config, "width"), darknet_value(options.config, "height")};
  }
  return {kDefaultInputSize, kDefaultInputSize};
}

void check(const NetworkDetectorOptions& options) {
  const auto in_unit = [](double value) { return value > 0 && value <= 1; };
  if (!in_unit(options.min_confidence) || !in_unit(options.max_overlap)) {
    throw std::invalid_argument("network detector: min_confidence " +
                                std::to_string(options.min_confidence) + " and max_overlap " +
                                std::to_string(options.max_overlap) + " must lie in (0, 1]");
  }
}

class NetworkDetector : public Detector {
 public:
  explicit NetworkDetector(const NetworkDetectorOptions& options) : options_(options) {
    check(options);
    net_ = load_net(options);
    class_names_ = load_lines(options.classes);
    wanted_ = find_wanted(options.wanted, class_names_);
    output_names_ = net_.getUnconnectedOutLayersNames();
    input_size_ = input_size(options);
    const std::vector<cv::Mat> outputs = run(cv::Mat::zeros(input_size_, CV_8UC3));
    const auto layout = guess_layout(outputs.front(), static_cast<int>(class_names_.size()));
    if (!layout) {
      fail("the output of '" + options.model + "' fits no YOLO layout with the " +
           std::to_string(class_names_.size()) + " classes of '" + options.classes + "'");
    }
    layout_ = *layout;
  }

  std::vector<Detection> detect(const CameraImage& image) override {
    cv::Mat picture = image.bgr;
    if (picture.empty()) cv::cvtColor(image.gray, picture, cv::COLOR_GRAY2BGR);
    std::vector<NetworkBox> boxes;
    for (const cv::Mat& output : run(picture)) {
      const auto more =
          decode_output(output, layout_, input_size_, wanted_, options_.min_confidence);
      boxes.insert(boxes.end(), more.begin(), more.end());
    }

    // From parts of the input to pixels of the picture.
    const cv::Size fitted = fitted_size(picture.size());
    const auto to_picture = [](double part, int input_px, int fitted_px, int picture_px) {
      const int padding = (input_px - fitted_px) / 2;
      const double px = (part * input_px - padding) * picture_px / fitted_px;
      return std::clamp(px, 0., static_cast<double>(picture_px));
    };
    const auto u = [&](double x) {
      return to_picture(x, input_size_.width, fitted.width, picture.cols);
    };
    const auto v = [&](double y) {
      return to_picture(y, input_size_.height, fitted.height, picture.rows);
    };
    std::vector<cv::Rect2d> rectangles;
    std::vector<float> scores;
    for (NetworkBox& found : boxes) {
      found.box = {u(found.box.left), v(found.box.top), u(found.box.right), v(found.box.bottom)};
      rectangles.emplace_back(found.box.left, found.box.top, found.box.width(), found.box.height());
      scores.push_back(static_cast<float>(found.score));
    }
    std::vector<int> kept;
    cv::dnn::NMSBoxes(rectangles, scores, static_cast<float>(options_.min_confidence),
                      static_cast<float>(options_.max_overlap), kept);
    std::vector<Detection> detections;
    for (const int i : kept) {
      if (boxes[i].box.area() <= 0) continue;
      detections.push_back({boxes[i].box, class_names_[boxes[i].class_id], boxes[i].score, -1});
    }
    return detections;
  }

 private:
  /// The part of the input that the picture covers: all of it for networks trained on stretched
  /// pictures, else the largest of the picture's own shape, centred.
  [[nodiscard]] cv::Size fitted_size(cv::Size picture) const {
    if (layout_ == NetworkLayout::region || layout_ == NetworkLayout::anchor_free)
      return input_size_;
    const double scale = std::min(static_cast<double>(input_size_.width) / picture.width,
                                  static_cast<double>(input_size_.height) / picture.height);
    return {std::max(1, cvRound(scale * picture.width)),
            std::max(1, cvRound(scale * picture.height))};
  }

  std::vector<cv::Mat> run(const cv::Mat& picture) {
    const cv::Size fitted = fitted_size(picture.size());
    cv::Mat input(input_size_, CV_8UC3, cv::Scalar::all(kPaddingGray));
    const cv::Rect inside((input_size_.width - fitted.width) / 2,
                          (input_size_.height - fitted.height) / 2, fitted.width, fitted.height);
    cv::Mat target = input(inside);
    cv::resize(picture, target, fitted, 0, 0, cv::INTER_LINEAR);
    const bool rgb = layout_ != NetworkLayout::anchor_free;  // FastestDet takes OpenCV's own order
    std::vector<cv::Mat> outputs;
    try {
      net_.setInput(cv::dnn::blobFromImage(input, 1. / 255, cv::Size(), cv::Scalar(), rgb));
      net_.forward(outputs, output_names_);
    } catch (const cv::Exception& error) {
      fail("'" + options_.model + "' does not run on an input of " +
           std::to_string(input_size_.width) + " x " + std::to_string(input_size_.height) +
           " (input_width, input_height): " + error.what());
    }
    return outputs;
  }

  NetworkDetectorOptions options_;
  std::vector<std::string> class_names_;
  std::vector<bool> wanted_;  ///< per class
  cv::dnn::Net net_;
  std::vector<std::string> output_names_;
  cv::Size input_size_;
  NetworkLayout layout_ = NetworkLayout::region;
};

}  // namespace

std::unique_ptr<Detector> make_network_detector(const NetworkDetectorOptions& options) {
  return std::make_unique<NetworkDetector>(options);
}

}  // namespace lidar_upsampling
