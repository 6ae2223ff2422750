// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "simulate.h"

#include <mrpt/obs/CSensoryFrame.h>

#include <algorithm>
#include <filesystem>
#include <optional>
#include <stdexcept>
#include <tuple>

#include "depth_observation.h"
#include "ego_observations.h"
#include "lidar_upsampling/io/carriers.h"
#include "lidar_upsampling/io/images.h"
#include "lidar_upsampling/io/rawlog_stream.h"
#include "lidar_upsampling/io/text_file.h"
#include "simulator/camera.h"
#include "simulator/lidar.h"
#include "simulator/sensor_errors.h"
#include "simulator/truth.h"

namespace lidar_upsampling::sim {

namespace {

/// In the order of the log at one stamp: a scan comes before the picture of the same instant.
enum class EventKind { ego, scan, image };

struct Event {
  Stamp stamp;  ///< in the log
  EventKind kind;
  int camera = 0;
  Stamp regular;  ///< of an image: what the stamp would be if the camera's clock kept time

  bool operator<(const Event& other) const {
    return std::tie(stamp, kind, camera) < std::tie(other.stamp, other.kind, other.camera);
  }
};

std::vector<Event> events_of(const Scenario& scenario) {
  std::vector<Event> events;
  if (scenario.ego_poses.kind != EgoPoseKind::none) {
    for (const Stamp s : stamps_of(scenario.ego_poses.rate_hz, 0, scenario.duration_s)) {
      events.push_back({s, EventKind::ego, 0, s});
    }
  }
  const LidarSpec& lidar = scenario.lidar;
  for (const Stamp s : stamps_of(lidar.rate_hz, lidar.phase_s, scenario.duration_s)) {
    events.push_back({s, EventKind::scan, 0, s});
  }
  for (std::size_t i = 0; i < scenario.cameras.size(); ++i) {
    const CameraSpec& camera = scenario.cameras[i];
    for (const Stamp s : stamps_of(camera.rate_hz, camera.phase_s, scenario.duration_s)) {
      const Stamp told = told_stamp(camera, s, scenario.duration_s, scenario.seed);
      events.push_back({told, EventKind::image, static_cast<int>(i), s});
    }
  }
  std::sort(events.begin(), events.end());
  return events;
}

/// Writes observations one by one, or gathers them into frames that end with a scan or picture, a
/// movement before each.
class LogFormatter {
 public:
  LogFormatter(RawlogWriter& writer, const World& world, LogFormat format)
      : writer_(writer), world_(world), format_(format) {}

  void add(const mrpt::obs::CObservation::Ptr& observation, EventKind kind) {
    if (format_ == LogFormat::observations) {
      writer_.write(*observation);
      return;
    }
    if (complete_ && observation->timestamp != last_) flush();
    frame_.insert(observation);
    last_ = observation->timestamp;
    complete_ = complete_ || kind != EventKind::ego;
  }

  void flush() {
    if (frame_.empty()) return;
    writer_.write(movement(world_, previous_, last_));
    writer_.write(frame_);
    frame_.clear();
    previous_ = last_;
    complete_ = false;
  }

 private:
  RawlogWriter& writer_;
  const World& world_;
  LogFormat format_;
  mrpt::obs::CSensoryFrame frame_;
  Stamp last_ = start_stamp(), previous_ = start_stamp();
  bool complete_ = false;
};

std::string beside(const std::string& log, const std::string& what) {
  std::filesystem::path path(log);
  if (path.extension() == ".gz") path.replace_extension();
  return path.replace_extension().string() + what;
}

// Velodyne scans are the only ones that keep each point's time in every MRPT.
Carrier carrier_of(const Scenario& scenario) {
  return scenario.carrier == "velodyne" ? Carrier::velodyne : carrier_from_string(scenario.carrier);
}

/// All that is written, and how.
class Simulation {
 public:
  explicit Simulation(const SimulationJob& job)
      : scenario_(job.scenario),
        world_(build_world(job.scenario)),
        carrier_(carrier_of(job.scenario)),
        log_(job.output, job.overwrite),
        formatter_(log_, world_, job.scenario.format),
        objects_(beside(job.output, "_objects.csv"), {job.overwrite}),
        ego_(beside(job.output, "_ego.csv"), {job.overwrite}),
        boxes_(beside(job.output, "_boxes.csv"), {job.overwrite}) {
    if (!job.truth.empty()) truth_.emplace(job.truth, job.overwrite);
    for (const CameraSpec& camera : scenario_.cameras) renderers_.emplace_back(camera);
    write_objects_header(objects_.stream());
    write_ego_header(ego_.stream());
    write_boxes_header(boxes_.stream());
    for (const Object& object : world_.objects) {
      if (!object.class_name.empty())
        ++(object.moves() ? summary_.num_moving : summary_.num_parked);
    }
  }

  void run(const std::function<void(double)>& progress) {
    const std::vector<Event> events = events_of(scenario_);
    for (std::size_t i = 0; i < events.size(); ++i) {
      handle(events[i]);
      progress(static_cast<double>(i + 1) / static_cast<double>(events.size()));
    }
    formatter_.flush();
  }

  SimulationSummary finish() {
    log_.finish();
    if (truth_) truth_->finish();
    objects_.commit();
    ego_.commit();
    boxes_.commit();
    if (truth_) truth_->commit();
    log_.commit();
    summary_.mean_points /= std::max(1, summary_.num_scans);
    return summary_;
  }

 private:
  void handle(const Event& event) {
    switch (event.kind) {
      case EventKind::ego:
        formatter_.add(ego_observation(world_, scenario_.ego_poses, event.stamp, scenario_.seed),
                       event.kind);
        ++summary_.num_ego;
        return;
      case EventKind::scan:
        add_scan(event.stamp);
        return;
      case EventKind::image:
        add_image(event);
        return;
    }
  }

  void add_scan(Stamp stamp) {
    add_truth(stamp);
    const bool is_truth = last_scan_ && !scenario_.lidar.sweep;
    const SimulatedScan simulated =
        is_truth ? *last_scan_ : scan_at(world_, scenario_.lidar, stamp, scenario_.seed);
    formatter_.add(observation_of(simulated.scan), EventKind::scan);
    ++summary_.num_scans;
    summary_.mean_points += static_cast<double>(simulated.scan.size());
  }

  void add_image(const Event& event) {
    add_truth(event.stamp);
    const CameraRenderer& renderer = renderers_[event.camera];
    RenderedImage picture = renderer.render(world_, event.regular, scenario_.seed);
    picture.image.stamp = event.stamp;
    picture.image.camera.T_vehicle_camera = told_mounting(renderer.spec(), scenario_.seed);
    write_boxes(boxes_.stream(), picture.image, true_boxes(world_, renderer, picture));
    formatter_.add(observation_from_image(picture.image), EventKind::image);
    ++summary_.num_images;
  }

  // Once per stamp, however many sensors share it.
  void add_truth(Stamp stamp) {
    if (stamp == truth_stamp_) return;
    truth_stamp_ = stamp;
    last_scan_.reset();
    write_objects(objects_.stream(), world_, stamp);
    write_ego(ego_.stream(), world_, stamp);
    if (!truth_) return;
    last_scan_ = snapshot(stamp);
    truth_->write(*pose_observation(world_, "GT", stamp));
    truth_->write(*observation_of(last_scan_->scan));
    ++summary_.num_truth_scans;
  }

  [[nodiscard]] mrpt::obs::CObservation::Ptr observation_of(const LidarScan& scan) const {
    if (scenario_.lidar.depth_camera) return depth_observation(scan, scenario_.lidar);
    return observation_from_scan(scan, carrier_);
  }

  [[nodiscard]] SimulatedScan snapshot(Stamp stamp) const {
    LidarSpec lidar = scenario_.lidar;
    lidar.sweep = false;
    return scan_at(world_, lidar, stamp, scenario_.seed);
  }

  Scenario scenario_;
  World world_;
  Carrier carrier_;
  RawlogWriter log_;
  LogFormatter formatter_;
  TextFile objects_, ego_, boxes_;
  std::optional<RawlogWriter> truth_;
  std::vector<CameraRenderer> renderers_;
  Stamp truth_stamp_;
  std::optional<SimulatedScan> last_scan_;  // at truth_stamp_, where there is a truth log
  SimulationSummary summary_;
};

}  // namespace

SimulationSummary simulate(const SimulationJob& job, const std::function<void(double)>& progress) {
  if (job.output == job.truth) {
    throw std::runtime_error(job.truth + ": the truth cannot go into the log itself");
  }
  Simulation simulation(job);
  simulation.run(progress);
  return simulation.finish();
}

}  // namespace lidar_upsampling::sim
