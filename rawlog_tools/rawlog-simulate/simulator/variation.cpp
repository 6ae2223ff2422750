// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "simulator/variation.h"

#include <algorithm>
#include <cmath>

#include "simulator/footprint.h"
#include "simulator/noise.h"

namespace lidar_upsampling::sim {

namespace {

constexpr int kTries = 24;

// Each number is drawn under a name, so that a new one changes none of the others.
enum Name : std::uint32_t {
  kSun = 1,
  kSky,
  kLidarNoise,
  kCameraNoise,
  kParked,
  kTrees,
  kPoles,
  kPedestrians,
  kEgo = 100,
  kVehicles = 1000
};

double spread(std::uint32_t seed, std::uint32_t name, double width) {
  return width * (2 * uniform(seed, name) - 1);
}

double factor(std::uint32_t seed, std::uint32_t name, double share) {
  return 1 + spread(seed, name, share);
}

// The same way, driven faster.
MotionProfile faster(MotionProfile motion, double factor) {
  motion.speed *= factor;
  for (MotionPhase& phase : motion.phases) {
    phase.t /= factor;
    phase.acceleration *= factor * factor;
    phase.yaw_rate *= factor;
  }
  return motion;
}

// Where it starts, and how fast it goes; `width` is the share of the spread that is made use of.
MotionProfile varied(const MotionProfile& written, const VariationSpec& spec, double speed_share,
                     double width, std::uint32_t seed) {
  MotionProfile motion = faster(written, factor(seed, 1, width * speed_share));
  const double along = spread(seed, 2, width * spec.place_m);
  const double across = spread(seed, 3, width * spec.across_m);
  const double c = std::cos(written.yaw), s = std::sin(written.yaw);
  motion.x += along * c - across * s;
  motion.y += along * s + across * c;
  return motion;
}

// Paint is mostly gray, from black to white, and sometimes of any hue.
Eigen::Vector3f paint(std::uint32_t seed) {
  const double value = std::exp(std::log(0.04) + uniform(seed, 1) * std::log(0.75 / 0.04));
  const double vivid = 0.9 * std::pow(uniform(seed, 2), 2), hue = 2 * M_PI * uniform(seed, 3);
  Eigen::Vector3f color;
  for (int i = 0; i < 3; ++i) {
    const double share = 0.5 + 0.5 * std::cos(hue - 2 * M_PI * i / 3);
    color[i] = static_cast<float>(value * (1 - vivid * (1 - share)));
  }
  return color;
}

/// Everybody who is on the way somewhere, the ego first. As written nobody touches another, and
/// every change is made so that it stays like that.
class Traffic {
 public:
  explicit Traffic(Scenario& scenario) : scenario_(scenario) {
    footprints_.push_back(ego_footprint(scenario.ego));
    for (std::size_t i = 0; i < scenario.vehicles.size(); ++i) {
      footprints_.push_back(footprint_of(i, scenario.vehicles[i]));
    }
  }

  void vary() {
    vary_ego();
    for (std::size_t i = 0; i < scenario_.vehicles.size(); ++i) vary_vehicle(i);
  }

 private:
  void vary_ego() {
    const VariationSpec& spec = scenario_.variation;
    const EgoSpec written = scenario_.ego;
    for (int i = 0; i < kTries; ++i) {
      EgoSpec tried = written;
      tried.motion = varied(written.motion, spec, spec.ego_speed_share, width_of(i),
                            hash(hash(scenario_.seed, kEgo), i));
      if (!take(0, ego_footprint(tried))) continue;
      scenario_.ego = tried;
      return;
    }
  }

  void vary_vehicle(std::size_t index) {
    const VariationSpec& spec = scenario_.variation;
    const VehicleSpec written = scenario_.vehicles[index];
    const std::uint32_t seed = hash(hash(scenario_.seed, kVehicles), index);
    if (spec.colors) scenario_.vehicles[index].color = paint(hash(seed, 1));
    for (int i = 0; i < kTries; ++i) {
      VehicleSpec tried = scenario_.vehicles[index];
      const std::uint32_t own = hash(seed, 10 + i);
      tried.motion = varied(written.motion, spec, spec.speed_share, width_of(i), own);
      // Who finds no room with another type keeps the own one.
      if (i < kTries / 2 && uniform(own, 4) < spec.type_share) {
        tried.type = written.type == "car" ? "van" : written.type == "van" ? "car" : written.type;
      }
      if (!take(index + 1, footprint_of(index, tried))) continue;
      scenario_.vehicles[index] = tried;
      return;
    }
  }

  [[nodiscard]] static double width_of(int attempt) {
    return 1 - static_cast<double>(attempt) / kTries;
  }

  [[nodiscard]] Footprint footprint_of(std::size_t index, const VehicleSpec& spec) const {
    Object object;
    object.shape = vehicle_shape(spec.type, vehicle_seed(scenario_.seed, index));
    object.motion = spec.motion;
    return sim::footprint_of(object);
  }

  bool take(std::size_t index, const Footprint& footprint) {
    for (std::size_t i = 0; i < footprints_.size(); ++i) {
      const double until = scenario_.duration_s;
      if (i != index && ever_touch(footprint, footprints_[i], until, kGap)) return false;
    }
    footprints_[index] = footprint;
    return true;
  }

  static constexpr double kGap = 0.35;
  Scenario& scenario_;
  std::vector<Footprint> footprints_;
};

void vary_surroundings(Scenario& scenario) {
  const VariationSpec& spec = scenario.variation;
  const std::uint32_t seed = hash(scenario.seed, 1);
  scenario.appearance.sun *= factor(seed, kSun, spec.light_share);
  scenario.appearance.sky *= factor(seed, kSky, spec.light_share);
  StreetSpec& street = scenario.street;
  const auto vary_share = [&](double& share, Name name) {
    share = std::min(1., share * factor(seed, name, spec.street_share));
  };
  vary_share(street.parked_cars, kParked);
  vary_share(street.trees, kTrees);
  vary_share(street.poles, kPoles);
  vary_share(street.pedestrians, kPedestrians);
}

void vary_sensors(Scenario& scenario) {
  const double share = scenario.variation.noise_share;
  const std::uint32_t seed = hash(scenario.seed, 2);
  const double of_lidar = factor(seed, kLidarNoise, share);
  scenario.lidar.noise_m *= of_lidar;
  scenario.lidar.noise_per_m2 *= of_lidar;
  for (std::size_t i = 0; i < scenario.cameras.size(); ++i) {
    scenario.cameras[i].noise *= factor(hash(seed, kCameraNoise), i, share);
  }
}

}  // namespace

Scenario drawn(const Scenario& written, std::uint32_t seed) {
  Scenario scenario = written;
  scenario.seed = seed;
  scenario.cleared_s = written.duration_s;
  vary_surroundings(scenario);
  vary_sensors(scenario);
  Traffic(scenario).vary();
  return scenario;
}

}  // namespace lidar_upsampling::sim
