// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <string>
#include <vector>

#include "argoverse2rawlog/argoverse_calibration.h"
#include "import/label_files.h"
#include "import/log_items.h"

namespace lidar_upsampling::argoverse {

struct StampedFile {
  Stamp stamp;
  std::string path;
};

/// @brief The files `<folder>/<prefix><nanoseconds><extension>` in time order, their nanoseconds
/// counted from 1970 and rounded to ticks; none if there is no such folder.
[[nodiscard]] std::vector<StampedFile> stamped_files(const std::string& folder,
                                                     const std::string& prefix,
                                                     const std::string& extension);

struct CameraFiles {
  Camera camera;
  std::vector<StampedFile> pictures;
};

/// An Argoverse 1 tracking log.
struct TrackingLog {
  Calibration calibration;
  std::vector<StampedFile> sweeps;
  std::vector<CameraFiles> cameras;
  std::vector<PoseSample> poses;  ///< of the vehicle in the city
  std::vector<importing::ObjectTrack> tracks;
};

/// @brief Lists sweeps and the named cameras' pictures, and reads calibration and poses.
/// @throw std::runtime_error the folder, its calibration, a camera, all sweeps or all pictures of a
/// camera are missing.
[[nodiscard]] TrackingLog open_log(const std::string& folder,
                                   const std::vector<std::string>& cameras);

/// @brief Adds the tracks of `per_sweep_annotations_amodal`.
/// @throw std::runtime_error there are none, or no poses to put them over ground with.
void add_tracks(TrackingLog& log, const std::string& folder);

/// Every sweep, picture and pose (label POSES). The log must outlive the items.
[[nodiscard]] std::vector<importing::LogItem> items_of(const TrackingLog& log);

[[nodiscard]] importing::LabelledLog labels_of(const TrackingLog& log);

}  // namespace lidar_upsampling::argoverse
