// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <mrpt/maps/CSimpleMap.h>
#include <mrpt/opengl/COpenGLScene.h>
#include <mrpt/version.h>

/// Where MRPT's releases differ, from 2.5.8 to 2.15: the only place that asks for its version, but
/// for point_fields.cpp beside it. Up to 2.10.1 MRPT_VERSION has a hexadecimal digit for each
/// number, from there on two, so that it grows. share/doc/mrpt-releases.md tells the rest of them.
namespace lidar_upsampling::compat {

/// Its maps insert a CObservationPointCloud as if the vehicle stood in the origin.
inline constexpr bool kMapsMisplacePointClouds = MRPT_VERSION < 0x020b03;

/// CObservationVelodyneScan::unload() erases points that have no packets.
inline constexpr bool kVelodyneLosesPoints = MRPT_VERSION >= 0x020d02;

/// Scenes go into a log under the class's new name, which releases before do not know.
inline constexpr bool kScenesAreNew = MRPT_VERSION >= 0x270;

/// Reads zstd, and its programs write it unless told otherwise.
inline constexpr bool kReadsZstd = MRPT_VERSION >= 0x020f07;

/// From 2.7 on it is an alias of mrpt::opengl::Scene.
using Scene = mrpt::opengl::COpenGLScene;

/// Where the vehicle was in the map, and what was observed there.
struct Keyframe {
  mrpt::poses::CPose3DPDF::ConstPtr pose;
  mrpt::obs::CSensoryFrame::ConstPtr frame;
};

[[nodiscard]] inline Keyframe keyframe_of(const mrpt::maps::CSimpleMap& map, std::size_t i) {
#if MRPT_VERSION >= 0x020b05
  const auto& keyframe = map.get(i);
  return {keyframe.pose, keyframe.sf};
#else
  Keyframe keyframe;
  map.get(i, keyframe.pose, keyframe.frame);
  return keyframe;
#endif
}

}  // namespace lidar_upsampling::compat
