// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "scan_results.h"

#include <filesystem>
#include <utility>

#include "evaluation.h"
#include "rawlog-densify/record_file.h"

namespace lidar_upsampling {
namespace {

template <typename Transfer, typename Object>
void transfer_result(Transfer& transfer, Object& result) {
  transfer(result.object.id);
  transfer(result.object.class_name);
  transfer(result.object.motion.centroid_k);
  transfer(result.object.motion.T_lidar_t_lidar_k);
  transfer(result.object.motion.sigma_m);
  transfer(result.object.moving);
  transfer(result.object.speed);
  transfer(result.object.excluded);
  transfer(result.num_points);
  transfer(result.errors);
}

/// All but the objects.
template <typename Transfer, typename Scan>
void transfer_scan(Transfer& transfer, Scan& scan) {
  transfer(scan.stamp);
  transfer(scan.key_stamp);
  transfer(scan.dt);
  transfer(scan.interpolated);
  transfer(scan.points_told);
  transfer(scan.clouds);
  for (const Row row : kRows) {
    transfer(scan.sampled[row].all);
    transfer(scan.sampled[row].inliers);
  }
  transfer(scan.moving_points_m);
  transfer(scan.static_error_m);
  transfer(scan.flow);
}

ObjectResult object_in(RecordReader& reading) {
  ObjectResult result;
  transfer_result(reading, result);
  bool is_known = false;
  reading(is_known);
  if (is_known) reading(result.estimates[Row::ours].emplace());
  return result;
}

}  // namespace

std::string scratch_place(const std::string& beside) {
  return beside.empty() ? (std::filesystem::temp_directory_path() / "evaluation").string() : beside;
}

ScanResults::ScanResults(std::string beside) : beside_(std::move(beside)) {}
ScanResults::~ScanResults() = default;
ScanResults::ScanResults(ScanResults&&) noexcept = default;
ScanResults& ScanResults::operator=(ScanResults&&) noexcept = default;

void ScanResults::add(const ScanResult& scan) {
  if (!file_) file_ = std::make_unique<RecordFile>(scratch_place(beside_));
  file_->add([&](RecordWriter& writing) {
    transfer_scan(writing, scan);
    writing(scan.objects.size());
    for (const ObjectResult& result : scan.objects) {
      transfer_result(writing, result);
      const auto& ours = result.estimates[Row::ours];
      writing(ours.has_value());
      if (ours) writing(*ours);
    }
  });
  if (size_ == 0) first_key_stamp_ = scan.key_stamp;
  ++size_;
}

void ScanResults::for_each(const std::function<void(ScanResult&)>& use) const {
  if (!file_) return;
  file_->for_each([&](RecordReader& reading) {
    ScanResult scan;
    transfer_scan(reading, scan);
    std::size_t num_objects = 0;
    reading(num_objects);
    for (std::size_t i = 0; i < num_objects; ++i) scan.objects.push_back(object_in(reading));
    use(scan);
  });
}

}  // namespace lidar_upsampling
