// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <mrpt/config/CLoadableOptions.h>

#include <string>
#include <vector>

#include "lidar_upsampling/ego/camera_ego.h"
#include "lidar_upsampling/ego/ego_motion.h"
#include "lidar_upsampling/ego/pose_file.h"
#include "lidar_upsampling/ego/static_points.h"
#include "lidar_upsampling/objects/detector.h"
#include "lidar_upsampling/objects/object_points.h"
#include "lidar_upsampling/objects/point_tracks.h"
#include "lidar_upsampling/objects/scene_segments.h"
#include "lidar_upsampling/scan/compose.h"
#include "lidar_upsampling/scan/resample.h"
#include "lidar_upsampling/scan/sweep.h"
#include "lidar_upsampling/tracks/object_tracks.h"
#include "lidar_upsampling/tracks/picture_motion.h"
#include "lidar_upsampling/vision/klt.h"

namespace lidar_upsampling {

/// How observations are brought together in time.
struct TimingOptions {
  double camera_time_offset_ms = 0;  ///< an image was taken this long before its stamp
  double pair_tolerance_ms = 2;      ///< an image this close to a scan shows the scan's own instant
  double min_gap_ms = 15;            ///< no virtual scan is due this close to a real one
  double group_tolerance_ms = 5;     ///< images of several cameras that make one virtual scan
  double max_key_age_ms = 500;       ///< no virtual scan from a scan older than this
  double max_anchor_gap_ms = 120;    ///< a picture this long before the scan may take its points
};

/// How each object's own motion is found.
struct ObjectMotionOptions {
  PictureMotionOptions picture;
  bool world_tracks = true;  ///< each object one track in the world; off: the paper
};

/// @brief All settings, with defaults that densify any sane log. Loaded from an INI file; the
/// section handed to `loadFromConfigFile` holds the main keys, each step has a section of its own.
struct Config : public mrpt::config::CLoadableOptions {
  std::string lidar_label;                 ///< empty: the only LiDAR there is
  std::vector<std::string> camera_labels;  ///< empty: every image stream with a calibration
  std::string output_label;                ///< empty: `<lidar_label>_VIRTUAL`
  std::string carrier = "auto";
  Compression compression = Compression::fast;
  std::string mode = "causal";
  int scans_ahead = 3;
  std::string preset = "default";
  std::string resample = "beam";
  int annotate = 0;

  ComposeOptions compose;
  TimingOptions timing;
  EgoMotionOptions ego_motion;
  PoseFileOptions pose_file;
  CameraEgoOptions camera_ego;
  StaticPointOptions static_points;
  DetectorOptions detector;
  SegmentOptions segments;
  ObjectPointOptions object_points;
  PointTrackOptions point_tracks;
  KltOptions klt;
  ObjectMotionOptions object_motion;
  TrackOptions object_tracks;
  ResampleOptions resampling;
  SweepOptions sweep;

  /// @throw std::invalid_argument naming section, key and value: an unknown key in a section of
  /// ours, a value of the wrong type or outside its range.
  void loadFromConfigFile(const mrpt::config::CConfigFileBase& source,
                          const std::string& main_section) override;
  void saveToConfigFile(mrpt::config::CConfigFileBase& target,
                        const std::string& main_section) const override;

  /// The label in force for virtual scans.
  [[nodiscard]] std::string virtual_label(const std::string& real_label) const;
};

/// The main keys' section in files of our own.
inline constexpr const char* kMainSection = "lidar_upsampling";

/// @brief Rejects sections that are neither ours nor those of the rig (`camera.*`, `lidar.*`): for
/// files that are all our own, where such a section is a misspelt one.
/// @throw std::invalid_argument with the sections there are.
void check_sections(const mrpt::config::CConfigFileBase& source);

/// @brief `config/default.ini`: every key with its default and a comment.
[[nodiscard]] std::string default_ini();

}  // namespace lidar_upsampling
