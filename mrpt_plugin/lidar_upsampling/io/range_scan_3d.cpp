// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/io/scan_classes.h"

#include <algorithm>
#include <cmath>
#include <opencv2/core/mat.hpp>
#include <opencv2/imgproc.hpp>
#include <stdexcept>
#include <string>

namespace lidar_upsampling {
namespace {

using mrpt::obs::CObservation3DRangeScan;

// What picture cells mean; kept in the name of the intensity camera, which no stock application
// reads.
const std::string kGrid = "lidar: ring x column";
const std::string kRings = "lidar: ring x number within the ring";
const std::string kList = "lidar: point by point";

struct Cells {
  std::string layout;
  int rows = 0;
  int columns = 0;
  std::vector<std::uint16_t> row;
  std::vector<std::uint16_t> column;
};

int size_from(const std::vector<std::uint16_t>& indices, int stated) {
  if (indices.empty()) return stated;
  return std::max(stated, 1 + *std::max_element(indices.begin(), indices.end()));
}

// Each ring's points are numbered, as nothing else tells them apart.
void number_within_rings(Cells& cells) {
  std::vector<int> count(static_cast<std::size_t>(cells.rows), 0);
  for (const std::uint16_t row : cells.row) {
    cells.column.push_back(static_cast<std::uint16_t>(count[row]++));
  }
  cells.columns = *std::max_element(count.begin(), count.end());
}

void number_row_by_row(int size, Cells& cells) {
  for (int i = 0; i < size; ++i) {
    cells.row.push_back(static_cast<std::uint16_t>(i / cells.columns));
    cells.column.push_back(static_cast<std::uint16_t>(i % cells.columns));
  }
}

Cells cells_of(const LidarScan& scan) {
  Cells cells;
  const std::size_t n = scan.size();
  if (n == 0) return cells;
  if (scan.ring.empty()) {
    cells.layout = kList;
    cells.columns = static_cast<int>(std::ceil(std::sqrt(static_cast<double>(n))));
    cells.rows = (static_cast<int>(n) + cells.columns - 1) / cells.columns;
    number_row_by_row(static_cast<int>(n), cells);
    return cells;
  }
  cells.rows = size_from(scan.ring, scan.num_rings);
  for (const std::uint16_t ring : scan.ring) {
    cells.row.push_back(static_cast<std::uint16_t>(cells.rows - 1 - ring));
  }
  if (scan.column.empty()) {
    cells.layout = kRings;
    number_within_rings(cells);
    return cells;
  }
  cells.layout = kGrid;
  cells.columns = size_from(scan.column, scan.num_columns);
  cells.column = scan.column;
  return cells;
}

mrpt::img::CImage intensity_picture(const LidarScan& scan, const Cells& cells) {
  cv::Mat picture = cv::Mat::zeros(cells.rows, cells.columns, CV_8UC1);
  for (std::size_t i = 0; i < scan.size(); ++i) {
    const float value = std::clamp(scan.intensity[i], 0.F, 1.F);
    picture.at<std::uint8_t>(cells.row[i], cells.column[i]) =
        static_cast<std::uint8_t>(std::lround(255.F * value));
  }
  return {picture, mrpt::img::SHALLOW_COPY};
}

bool all_zero(const std::vector<std::uint16_t>& values) {
  return std::all_of(values.begin(), values.end(), [](std::uint16_t v) { return v == 0; });
}

// The picture that the points' indices refer to: rows and columns, 0 if there is none.
Cells stored_cells(const CObservation3DRangeScan& observation) {
  Cells cells;
  const std::string& name = observation.cameraParamsIntensity.cameraName;
  cells.layout = name == kRings || name == kList ? name : kGrid;
  cells.row = observation.points3D_idxs_y;
  cells.column = observation.points3D_idxs_x;
  const std::size_t n = observation.points3D_x.size();
  const bool without = cells.row.size() != n || cells.column.size() != n ||
                       (all_zero(cells.row) && all_zero(cells.column) && n > 1);
  if (without) return {};
  if (observation.hasRangeImage && observation.rangeImage.rows() > 0) {
    cells.rows = static_cast<int>(observation.rangeImage.rows());
    cells.columns = static_cast<int>(observation.rangeImage.cols());
  } else if (observation.hasIntensityImage && !observation.intensityImage.isEmpty()) {
    cells.rows = static_cast<int>(observation.intensityImage.getHeight());
    cells.columns = static_cast<int>(observation.intensityImage.getWidth());
  } else if (name == kGrid || name == kRings) {
    cells.rows = static_cast<int>(observation.cameraParamsIntensity.nrows);
    cells.columns = static_cast<int>(observation.cameraParamsIntensity.ncols);
  }
  cells.rows = size_from(cells.row, cells.rows);
  cells.columns = size_from(cells.column, cells.columns);
  return cells;
}

// Gray values of the cells; empty where the picture belongs to another place than the points.
cv::Mat gray_of_cells(const CObservation3DRangeScan& observation, const Cells& cells) {
  if (!observation.hasIntensityImage || observation.intensityImage.isEmpty()) return {};
  if (!observation.doDepthAndIntensityCamerasCoincide()) return {};
  cv::Mat picture = observation.intensityImage.asCvMat<cv::Mat>(mrpt::img::SHALLOW_COPY);
  if (picture.rows != cells.rows || picture.cols != cells.columns) return {};
  if (picture.depth() != CV_8U) picture.convertTo(picture, CV_8U, 1. / 257.);
  if (picture.channels() == 1) return picture;
  cv::Mat gray;
  cv::cvtColor(picture, gray, picture.channels() == 4 ? cv::COLOR_BGRA2GRAY : cv::COLOR_BGR2GRAY);
  return gray;
}

void append_point(const Eigen::Vector3f& point, const Cells& cells, const cv::Mat& gray,
                  std::size_t index, LidarScan& scan) {
  if (!is_measured(point)) return;
  scan.points.push_back(point);
  if (cells.rows == 0) return;
  const int row = cells.row[index];
  const int column = cells.column[index];
  if (cells.layout != kList) scan.ring.push_back(static_cast<std::uint16_t>(cells.rows - 1 - row));
  if (cells.layout == kGrid) scan.column.push_back(static_cast<std::uint16_t>(column));
  if (!gray.empty()) scan.intensity.push_back(gray.at<std::uint8_t>(row, column) / 255.F);
}

void read_points(const CObservation3DRangeScan& observation, LidarScan& scan) {
  const Cells cells = stored_cells(observation);
  const cv::Mat gray = gray_of_cells(observation, cells);
  const std::size_t n = observation.points3D_x.size();
  if (observation.points3D_y.size() != n || observation.points3D_z.size() != n)
    throw std::runtime_error("its points have " + std::to_string(n) +
                             " x, but not as many y and z");
  for (std::size_t i = 0; i < n; ++i) {
    const Eigen::Vector3f point(observation.points3D_x[i], observation.points3D_y[i],
                                observation.points3D_z[i]);
    append_point(point, cells, gray, i, scan);
  }
  scan.num_rings = scan.ring.empty() ? 0 : cells.rows;
  scan.num_columns = scan.column.empty() ? 0 : cells.columns;
}

void read_range_picture(const CObservation3DRangeScan& observation, LidarScan& scan) {
  const auto& ranges = observation.rangeImage;
  Cells cells;
  cells.layout = kGrid;
  cells.rows = static_cast<int>(ranges.rows());
  cells.columns = static_cast<int>(ranges.cols());
  const auto& directions = observation.get_unproj_lut();
  const cv::Mat gray = gray_of_cells(observation, cells);
  number_row_by_row(cells.rows * cells.columns, cells);
  for (std::size_t i = 0; i < cells.row.size(); ++i) {
    const float range =
        static_cast<float>(ranges(cells.row[i], cells.column[i])) * observation.rangeUnits;
    const Eigen::Vector3f direction(directions.Kxs[i], directions.Kys[i], directions.Kzs[i]);
    append_point(range * direction, cells, gray, i, scan);
  }
  scan.num_rings = cells.rows;
  scan.num_columns = cells.columns;
}

}  // namespace

CObservation3DRangeScan::Ptr make_range_scan_3d(const LidarScan& scan) {
  auto observation = CObservation3DRangeScan::Create();
  observation->hasPoints3D = true;
  observation->resizePoints3DVectors(scan.size());
  double sq_max_range = 0;
  for (std::size_t i = 0; i < scan.size(); ++i) {
    const Eigen::Vector3f& p = scan.points[i];
    // MRPT takes the exact origin for "no return".
    observation->points3D_x[i] = p.isZero(0.F) ? 1e-6F : p.x();
    observation->points3D_y[i] = p.y();
    observation->points3D_z[i] = p.z();
    sq_max_range = std::max(sq_max_range, p.cast<double>().squaredNorm());
  }
  observation->maxRange = static_cast<float>(std::ceil(std::sqrt(sq_max_range)));
  const Cells cells = cells_of(scan);
  if (cells.rows == 0) return observation;
  observation->points3D_idxs_x = cells.column;
  observation->points3D_idxs_y = cells.row;
  observation->cameraParamsIntensity.cameraName = cells.layout;
  observation->cameraParamsIntensity.ncols = static_cast<std::uint32_t>(cells.columns);
  observation->cameraParamsIntensity.nrows = static_cast<std::uint32_t>(cells.rows);
  observation->hasIntensityImage = !scan.intensity.empty();
  if (observation->hasIntensityImage) {
    observation->intensityImage = intensity_picture(scan, cells);
  }
  return observation;
}

void read_range_scan_3d(const CObservation3DRangeScan& observation, LidarScan& scan) {
  if (observation.hasPoints3D && !observation.points3D_x.empty()) {
    read_points(observation, scan);
  } else if (observation.hasRangeImage && observation.rangeImage.rows() > 0) {
    read_range_picture(observation, scan);
  }
}

}  // namespace lidar_upsampling
