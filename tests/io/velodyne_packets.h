// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <mrpt/obs/CObservationVelodyneScan.h>

#include <cmath>
#include <cstring>
#include <functional>

#include "lidar_upsampling/types.h"

namespace lidar_upsampling {

inline constexpr int kNumPackets = 75;  ///< of a turn

inline void put_number(std::uint8_t* at, int value, int num_bytes) {
  for (int i = 0; i < num_bytes; ++i) at[i] = static_cast<std::uint8_t>(value >> (8 * i));
}

/// A turn of a VLP-16, on packets as the device sends them: two firings per block, 0.1 s in all.
/// @param range of a laser, metres, by the sine of its elevation.
inline mrpt::obs::CObservationVelodyneScan velodyne_packets(
    Stamp stamp, const std::function<double(double)>& range) {
  using mrpt::obs::CObservationVelodyneScan;
  CObservationVelodyneScan observation;
  observation.sensorLabel = "VLP";
  observation.timestamp = observation.originalReceivedTimestamp = stamp;
  observation.calibration = mrpt::obs::VelodyneCalibration::LoadDefaultCalibration("VLP16");
  observation.scan_packets.resize(kNumPackets);
  for (int packet = 0; packet < kNumPackets; ++packet) {
    std::uint8_t bytes[CObservationVelodyneScan::PACKET_SIZE] = {};
    for (int block = 0; block < 12; ++block) {
      std::uint8_t* const out = bytes + block * 100;
      put_number(out, CObservationVelodyneScan::UPPER_BANK, 2);
      put_number(out + 2, (packet * 12 + block) * 36000 / (kNumPackets * 12), 2);
      for (int beam = 0; beam < 32; ++beam) {
        const auto& laser = observation.calibration.laser_corrections[beam % 16];
        put_number(out + 4 + 3 * beam,
                   static_cast<int>(std::lround(range(laser.sinVertCorrection) / 0.002)), 2);
        put_number(out + 6 + 3 * beam, 51, 1);
      }
    }
    put_number(bytes + 1200, packet * 1327, 4);
    bytes[1204] = CObservationVelodyneScan::RETMODE_STRONGEST;
    bytes[1205] = 0x22;
    std::memcpy(&observation.scan_packets[static_cast<std::size_t>(packet)], bytes, sizeof bytes);
  }
  return observation;
}

}  // namespace lidar_upsampling
