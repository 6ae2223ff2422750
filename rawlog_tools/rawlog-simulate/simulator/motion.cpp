// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "simulator/motion.h"

#include <cmath>
#include <map>
#include <sstream>
#include <stdexcept>

#include "lidar_upsampling/units.h"

namespace lidar_upsampling::sim {

namespace {

[[noreturn]] void refuse_phase(const std::string& text, const std::string& item) {
  throw std::invalid_argument(
      "motion \"" + text + "\": \"" + item +
      "\" is neither constant, brake, accelerate, turn_left, turn_right nor three numbers "
      "\"t acceleration yaw_rate_deg\"");
}

// Integral of (v + a s) (cos, sin)(yaw + w s) over s in [0, dt].
Eigen::Vector2d displacement(double v, double a, double yaw, double w, double dt) {
  if (std::abs(w) < 1e-6) {
    const double length = v * dt + 0.5 * a * dt * dt;
    return length * Eigen::Vector2d(std::cos(yaw + 0.5 * w * dt), std::sin(yaw + 0.5 * w * dt));
  }
  const double end = yaw + w * dt;
  const double v_end = v + a * dt;
  return {(v_end * std::sin(end) - v * std::sin(yaw)) / w +
              a * (std::cos(end) - std::cos(yaw)) / (w * w),
          (-v_end * std::cos(end) + v * std::cos(yaw)) / w +
              a * (std::sin(end) - std::sin(yaw)) / (w * w)};
}

void advance(MotionState& state, const MotionPhase& phase, double dt) {
  const bool stops = phase.acceleration < 0 && state.speed + phase.acceleration * dt <= 0;
  const double rolling = stops ? -state.speed / phase.acceleration : dt;
  const bool moves = state.speed > 0 || phase.acceleration > 0;
  state.yaw_rate = 0;
  if (!moves) return;
  const Eigen::Vector2d step =
      displacement(state.speed, phase.acceleration, state.yaw, phase.yaw_rate, rolling);
  state.x += step.x();
  state.y += step.y();
  state.yaw += phase.yaw_rate * rolling;
  state.speed = stops ? 0 : state.speed + phase.acceleration * rolling;
  state.yaw_rate = stops ? 0 : phase.yaw_rate;
}

}  // namespace

Pose MotionState::pose() const {
  Pose T = Pose::Identity();
  T.translation() << x, y, z;
  T.linear() = Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  return T;
}

MotionState state_at(const MotionProfile& profile, double t) {
  MotionState state{profile.x, profile.y, profile.yaw, profile.z, profile.speed, 0};
  double now = 0;
  MotionPhase current;
  for (const MotionPhase& next : profile.phases) {
    if (next.t > t) break;
    advance(state, current, next.t - now);
    now = next.t;
    current = next;
  }
  advance(state, current, t - now);
  return state;
}

std::vector<MotionPhase> parse_phases(const std::string& text) {
  static const std::map<std::string, std::vector<MotionPhase>> named{
      {"", {}},
      {"constant", {}},
      {"brake", {{0.5, -4, 0}}},
      {"accelerate", {{0, 2.5, 0}}},
      {"turn_left", {{0, 0, 35 * kDegree}}},
      {"turn_right", {{0, 0, -35 * kDegree}}}};
  if (const auto it = named.find(text); it != named.end()) return it->second;

  std::vector<MotionPhase> phases;
  std::istringstream list(text);
  for (std::string item; std::getline(list, item, ';');) {
    std::istringstream numbers(item);
    MotionPhase phase;
    double yaw_rate_deg = 0;
    std::string rest;
    if (!(numbers >> phase.t >> phase.acceleration >> yaw_rate_deg) || numbers >> rest)
      refuse_phase(text, item);
    phase.yaw_rate = yaw_rate_deg * kDegree;
    if (phase.t < 0 || (!phases.empty() && phase.t <= phases.back().t)) {
      throw std::invalid_argument("motion \"" + text + "\": its times must grow from 0 on");
    }
    phases.push_back(phase);
  }
  return phases;
}

}  // namespace lidar_upsampling::sim
