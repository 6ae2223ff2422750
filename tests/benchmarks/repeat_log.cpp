// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include <mrpt/obs/CObservationRobotPose.h>

#include <CLI/CLI.hpp>
#include <exception>
#include <iostream>
#include <optional>
#include <stdexcept>
#include <string>

#include "lidar_upsampling/io/images.h"
#include "lidar_upsampling/io/rawlog_stream.h"

namespace {

using namespace lidar_upsampling;  // NOLINT(google-build-using-namespace)

struct Request {
  std::string input, output;
  double seconds = 3600;
};

/// A log once more, later and from where the vehicle was at its end.
class Repetition {
 public:
  Repetition(double shift_s, const Pose& T_world_first) : shift_s_(shift_s), T_(T_world_first) {}

  void shift(mrpt::obs::CObservation& observation) {
    observation.timestamp = shifted(observation.timestamp, shift_s_);
    last_ = observation.timestamp;
    if (!first_) first_ = last_;
    auto* const pose = dynamic_cast<mrpt::obs::CObservationRobotPose*>(&observation);
    if (pose == nullptr) return;
    const Pose own = from_mrpt(pose->pose.mean);
    if (!T_first_world_) T_first_world_ = own.inverse();
    last_pose_ = T_ * *T_first_world_ * own;
    pose->pose.mean = to_mrpt(last_pose_);
  }

  [[nodiscard]] double length_s() const { return first_ ? seconds_between(*first_, last_) : 0; }
  [[nodiscard]] const Pose& last_pose() const { return last_pose_; }

 private:
  double shift_s_;
  Pose T_, last_pose_ = T_;
  std::optional<Pose> T_first_world_;
  std::optional<Stamp> first_;
  Stamp last_{};
};

void repeat(const Request& request) {
  constexpr double kBetween_s = 0.1;  // the end of one to the begin of the next
  RawlogWriter writer(request.output, true);
  Pose T = Pose::Identity();
  for (double shift_s = 0; shift_s < request.seconds;) {
    RawlogReader reader(request.input);
    Repetition repetition(shift_s, T);
    while (const auto entry = reader.next()) {
      auto* const observation = dynamic_cast<mrpt::obs::CObservation*>(entry->object.get());
      if (observation == nullptr) throw std::runtime_error("only logs without frames are repeated");
      repetition.shift(*observation);
      writer.write(*observation);
    }
    T = repetition.last_pose();
    shift_s += repetition.length_s() + kBetween_s;
  }
  writer.commit();
  std::cout << writer.num_written() << " objects in " << request.output << '\n';
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Makes a long log of a short one, again and again, each time later and further on");
  Request request;
  app.add_option("--input", request.input, "the short log, without frames")->required();
  app.add_option("--output", request.output, "the long one")->required();
  app.add_option("--seconds", request.seconds, "of the long one")->capture_default_str();
  CLI11_PARSE(app, argc, argv);
  try {
    repeat(request);
    return 0;
  } catch (const std::exception& error) {
    std::cerr << error.what() << '\n';
    return 1;
  }
}
