// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "fuzz/observation_mutations.h"

#include <mrpt/obs/CObservationGPS.h>
#include <mrpt/obs/CObservationImage.h>
#include <mrpt/obs/CObservationOdometry.h>
#include <mrpt/obs/CObservationRobotPose.h>
#include <mrpt/obs/CSensoryFrame.h>

#include <string>
#include <vector>

#include "fuzz/field_mutations.h"

namespace lidar_upsampling::fuzz {
namespace {

using mrpt::obs::CObservation;

void spoil_image(mrpt::obs::CObservationImage& image, Random& random) {
  switch (random.below(4)) {
    case 0:
      image.image = odd_picture(random);
      return;
    case 1:
      image.image = mrpt::img::CImage();
      image.image.setExternalStorage(
          random.pick(std::vector<std::string>{"none.png", "", "/", "in.rawlog", "\xe4.png"}));
      return;
    default:
      return spoil(image.cameraParams, random);
  }
}

void spoil_other(CObservation& other, Random& random) {
  if (auto* const pose = dynamic_cast<mrpt::obs::CObservationRobotPose*>(&other))
    pose->pose.mean = odd_pose(pose->pose.mean, random);
  if (auto* const odometry = dynamic_cast<mrpt::obs::CObservationOdometry*>(&other))
    odometry->odometry.x(random.odd_number());
  auto* const gps = dynamic_cast<mrpt::obs::CObservationGPS*>(&other);
  if (gps == nullptr || !gps->has_GGA_datum()) return;
  auto& fields = gps->getMsgByClass<mrpt::obs::gnss::Message_NMEA_GGA>().fields;
  (random.one_in(2) ? fields.latitude_degrees : fields.altitude_meters) = random.odd_number();
}

void spoil_head(CObservation& observation, Random& random) {
  static const std::vector<std::string> kLabels{
      "",          "LIDAR",         "CAM",
      "POSE",      "LIDAR_VIRTUAL", "/lidar/points",
      "L\xe4\xff", "a b\n\tc",      std::string(300, 'x')};
  switch (random.below(3)) {
    case 0:
      observation.timestamp = odd_stamp(observation.timestamp, random);
      return;
    case 1:
      observation.sensorLabel = random.pick(kLabels);
      return;
    default:
      mrpt::poses::CPose3D pose;
      observation.getSensorPose(pose);
      observation.setSensorPose(odd_pose(pose, random));
  }
}

}  // namespace

void spoil(mrpt::serialization::CSerializable& object, Random& random, Sizes sizes) {
  if (auto* const frame = dynamic_cast<mrpt::obs::CSensoryFrame*>(&object)) {
    if (!frame->empty())
      spoil(*frame->getObservationByIndex(random.below(frame->size())), random, sizes);
    return;
  }
  auto* const observation = dynamic_cast<CObservation*>(&object);
  if (observation == nullptr) return;
  if (random.one_in(3)) {
    spoil_head(*observation, random);
    return;
  }
  if (spoil_scan(*observation, random, sizes)) return;
  if (auto* const image = dynamic_cast<mrpt::obs::CObservationImage*>(observation))
    spoil_image(*image, random);
  else
    spoil_other(*observation, random);
}

}  // namespace lidar_upsampling::fuzz
