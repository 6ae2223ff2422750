// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "mrpt_needs.h"

#include <algorithm>
#include <stdexcept>

#include "lidar_upsampling/compat/mrpt.h"
#include "lidar_upsampling/compat/point_fields.h"

namespace lidar_upsampling {

MrptRelease parse_release(const std::string& text) {
  MrptRelease release;
  std::size_t begin = 0;
  for (bool has_more = true; has_more;) {
    const std::size_t end = std::min(text.find('.', begin), text.size());
    const std::string number = text.substr(begin, end - begin);
    if (number.empty() || number.size() > 3 ||
        number.find_first_not_of("0123456789") != std::string::npos)
      throw std::invalid_argument("'" + text + "' is no release of MRPT, as 2.5 or 2.15.7");
    release.numbers.push_back(std::stoi(number));
    has_more = end < text.size();
    begin = end + 1;
  }
  return release;
}

std::vector<MrptNeed> needs_of(const Config& config) {
  std::vector<MrptNeed> needs;
  if (config.compression.format == Compression::Format::zstd)
    needs.push_back({"compression = " + to_text(config.compression), "2.15.7"});
  if (config.annotate != 0 && compat::kScenesAreNew) needs.push_back({"annotate = 1", "2.7"});
  if (config.carrier == "pointcloud" && compat::maps_with_rings_since() != nullptr)
    needs.push_back({"carrier = pointcloud", compat::maps_with_rings_since()});
  return needs;
}

void check_readable_by(const MrptRelease& release, const Config& config) {
  for (const MrptNeed& need : needs_of(config))
    if (release < parse_release(need.since))
      throw std::runtime_error("--for-mrpt: " + need.setting + ", written by this MRPT, needs " +
                               need.since + " or newer to be read");
}

void warn_of_newer_mrpt(const Config& config, DensifyReport& report) {
  for (const MrptNeed& need : needs_of(config))
    report.warn("MRPT before " + need.since + " cannot read this log", need.setting);
}

}  // namespace lidar_upsampling
