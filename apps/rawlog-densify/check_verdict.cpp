// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include <algorithm>
#include <cmath>
#include <sstream>

#include "check.h"

namespace lidar_upsampling {
namespace {

bool any_between_scans(const StreamInfo& camera, std::vector<Stamp> scans) {
  const double gap_s = 1e-3 * TimingOptions().min_gap_ms;
  std::sort(scans.begin(), scans.end());
  return std::any_of(camera.stamps.begin(), camera.stamps.end(), [&](Stamp image) {
    const auto next = std::lower_bound(scans.begin(), scans.end(), image);
    return next != scans.begin() && next != scans.end() && seconds_between(image, *next) > gap_s &&
           seconds_between(*std::prev(next), image) > gap_s;
  });
}

std::string listed(const std::vector<std::string>& items) {
  std::string text;
  for (const std::string& item : items) text += (text.empty() ? "" : "; ") + item;
  return text;
}

}  // namespace

std::optional<double> offset_to_set_ms(const CameraCheck& camera, double in_force_ms) {
  constexpr double kSure = 2;  // sigmas
  if (!camera.time_offset || camera.time_offset->sigma_s > TimeOffsetOptions().max_sigma_s)
    return {};
  const double ms = 1e3 * camera.time_offset->offset_s;
  if (std::abs(ms - in_force_ms) < kSure * 1e3 * camera.time_offset->sigma_s) return {};
  return ms;
}

std::string verdict_of(const LogCheck& check) {
  constexpr double kHardlyAny = 0.01;
  std::vector<std::string> unfit, to_set;
  const StreamInfo* const lidar = check.index.find(check.lidar_label, StreamKind::lidar);
  bool any_between = false, any_used = check.cameras.empty();
  for (const CameraCheck& camera : check.cameras) {
    const std::string& label = camera.camera.label;
    const StreamInfo* const images = check.index.find(label, StreamKind::camera);
    any_between = any_between || (images != nullptr && lidar != nullptr &&
                                  any_between_scans(*images, lidar->stamps));
    any_used = any_used || camera.num_compared > 0;
    if (camera.num_compared > 0 && camera.share_in_view < kHardlyAny)
      unfit.push_back(label + " sees hardly a point of the scans: is its pose right ([camera." +
                      label + "] pose)?");
    if (const auto ms = offset_to_set_ms(camera, check.time_offset_in_force_ms)) {
      std::ostringstream text;
      text.setf(std::ios::fixed);
      text.precision(1);
      text << "--set timing.camera_time_offset_ms=" << *ms;
      to_set.push_back(text.str());
    }
  }
  if (!any_used) unfit.emplace_back("no picture can be used with a scan");
  if (!any_between) unfit.emplace_back("no image falls between two scans");
  if (check.index.corruption) to_set.emplace_back("--accept-truncated");
  if (unfit.empty() && to_set.empty()) return "fit as it is";
  const std::string verdict = unfit.empty() ? "fit" : "not fit: " + listed(unfit);
  return verdict + (to_set.empty() ? "" : ", with " + listed(to_set));
}

}  // namespace lidar_upsampling
