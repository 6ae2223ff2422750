// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <memory>
#include <vector>

#include "lidar_upsampling/camera_view.h"
#include "lidar_upsampling/image_result.h"
#include "lidar_upsampling/prepared_scan.h"

/// What a camera shows of the key scan's objects: points chosen on the anchor picture, followed to
/// the next ones.
namespace lidar_upsampling {

/// The key scan's objects and their tracks.
struct KeyObjects {
  const PreparedScan& key;
  const TrackStore& store;
  const std::vector<int>& track_of;  ///< of each object

  [[nodiscard]] const ScanObject& object(std::size_t i) const { return key.objects[i]; }
  [[nodiscard]] const ObjectTrack& track(std::size_t i) const { return store.tracks[track_of[i]]; }
};

/// @brief Puts the key scan on the anchor picture and chooses the points to follow (paper,
/// "Defining Object Points and Tracking Them").
/// @param ego from the key scan to the anchor.
void start_view(CameraView& view, const std::shared_ptr<const Picture>& anchor,
                const KeyObjects& objects, const EgoStep& ego, const Config& config);

/// @brief Follows all points to the next picture, from where each object may have gone.
/// @param ego from the key scan to the picture, as expected.
/// @return of each object, `starts` only.
[[nodiscard]] std::vector<ObjectOnPicture> follow_objects(CameraView& view, const Picture& picture,
                                                          const KeyObjects& objects,
                                                          const Pose& ego, const Config& config);

/// @brief Completes what the picture shows of each object, by the ego-motion until then.
void note_sights(std::vector<ObjectOnPicture>& sights, const CameraView& view,
                 const Picture& picture, const KeyObjects& objects, const Pose& ego,
                 const Config& config);

}  // namespace lidar_upsampling
