// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <vector>

#include "lidar_upsampling/camera_view.h"
#include "lidar_upsampling/objects/object_motion.h"

namespace lidar_upsampling {

/// All that is asked about one candidate at a picture, and the answer.
struct Question {
  MotionQuery query;
  std::vector<Correspondence> pairs;
  ObjectMotion motion;
};

/// @brief Answers the question anew with what was known before, the next scan and the picture
/// together. Registration starts where the picture leads; what it finds must not contradict the
/// picture. Sets `to_next` and `at_next` of the candidate.
/// @param question answered by the picture and what was known before.
void use_next_scan(Candidate& candidate, Question& question, const CameraView& view,
                   const LidarScan& key_scan, const NextScan& next,
                   const ObjectMotionOptions& options);

/// @brief Lets the picture's step weigh in on `at_next` where it tells the velocity better than the
/// next scan. It was made with that scan's already, which therefore does not count again.
/// @param motion the final answer to `query`, of a candidate that has `at_next`.
void learn_from_picture(Candidate& candidate, const ObjectMotion& motion, const MotionQuery& query,
                        const CameraView& view, const MotionPriorOptions& options);

}  // namespace lidar_upsampling
