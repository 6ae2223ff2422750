// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include <mrpt/obs/CSensoryFrame.h>

#include <filesystem>
#include <sstream>
#include <utility>

#include "fuzz/fuzz_folder.h"
#include "fuzz/log_mutations.h"
#include "fuzz/observation_mutations.h"
#include "fuzz/target.h"
#include "lidar_upsampling/io/carriers.h"
#include "lidar_upsampling/io/rawlog_stream.h"
#include "plugin/live_upsampling.h"
#include "rawlog-densify/check.h"
#include "rawlog-densify/densify.h"
#include "rawlog-densify/job_settings.h"

namespace lidar_upsampling::fuzz {
namespace {

std::vector<std::string> drawn_settings(Random& random) {
  static const std::vector<std::string> kSettings{"resample=none",
                                                  "mode=offline",
                                                  "scan_time=points",
                                                  "scan_time=azimuth",
                                                  "carrier=same",
                                                  "carrier=pointcloud",
                                                  "annotate=1",
                                                  "preset=paper",
                                                  "ego_motion.source=camera",
                                                  "ego_motion.source=gnss",
                                                  "ego_motion.source=none",
                                                  "compression=none",
                                                  "camera_labels=CAM",
                                                  "lidar_label=LIDAR"};
  std::vector<std::string> sets;
  for (std::size_t i = random.below(3); i > 0; --i) sets.push_back(random.pick(kSettings));
  return sets;
}

DensifyJob job_with(const std::vector<std::string>& settings) {
  DensifyJob job;
  job.input = in_work_folder("in.rawlog");
  job.output = in_work_folder("out.rawlog");
  job.overwrite = true;
  load_settings(job, "", settings, "");
  return job;
}

DensifyJob drawn_job(Random& random) {
  DensifyJob job = job_with(drawn_settings(random));
  job.accept_truncated = !random.one_in(4);
  return job;
}

bool is_frame(const RawlogEntry& entry) {
  return dynamic_cast<const mrpt::obs::CSensoryFrame*>(entry.object.get()) != nullptr;
}

// The output is a whole log, and all that could be read of the input is in it, byte for byte; of
// frames, that they are there.
void check_output(const DensifyJob& job) {
  RawlogReader in({job.input, job.accept_truncated}), out(job.output);
  try {
    while (const auto real = in.next()) {
      auto entry = out.next();
      while (entry && entry->bytes != real->bytes && !(is_frame(*real) && is_frame(*entry)))
        entry = out.next();
      if (!entry) throw Finding("an observation is not in the output");
    }
    while (out.next()) continue;
  } catch (const CorruptRawlog& error) {
    throw Finding(std::string("the output is no whole log: ") + error.what());
  }
}

void densify_log(const DensifyJob& job, Random& random) {
  const DensifyReport report = densify(job, nullptr);
  check_output(job);
  std::ostringstream text;
  write_json(report, text);
  text << summary(report);
  if (random.one_in(6)) static_cast<void>(to_text(check_log(job, [](double) {})));
}

void run_log(const LogSeed& seed, Random& random) {
  write_file_of(in_work_folder("in.rawlog"), damaged_log(seed, random));
  densify_log(drawn_job(random), random);
}

void run_whole_log(const LogSeed& seed) {
  write_file_of(in_work_folder("in.rawlog"), whole_log(seed));
  DensifyJob job = job_with({});
  const DensifyReport report = densify(job, nullptr);
  check_output(job);
  if (report.num_virtual_scans == 0) throw Finding("no virtual scan is made of " + seed.name);
}

Role role_of(const mrpt::obs::CObservation& observation) {
  if (observation.sensorLabel == "LIDAR" && is_lidar_scan(observation)) return Role::scan;
  return observation.sensorLabel == "CAM" ? Role::image : Role::other;
}

mrpt::obs::CObservation::Ptr copy_of(const mrpt::serialization::CSerializable::Ptr& object) {
  return std::dynamic_pointer_cast<mrpt::obs::CObservation>(
      mrpt::rtti::CObject::Ptr(object->clone()));
}

// As drivers hand them over, which no file has made sure that they fit together.
void run_live(Random& random, bool spoils) {
  DensifyJob job = drawn_job(random);
  job.config.mode = "causal";
  Messages messages;
  LiveUpsampling upsampling(job.config, job.rig, messages);
  std::size_t num_in = 0, num_out = 0;
  const auto note = [&](const std::vector<Emitted>& emitted) {
    for (const Emitted& one : emitted)
      if (!one.image_arrival && one.observation->sensorLabel.find("_OBJECTS") == std::string::npos)
        ++num_out;
  };
  for (const auto& object : random.pick(log_seeds()).objects) {
    const auto observation = copy_of(object);
    if (!observation) continue;
    if (spoils && random.one_in(4)) spoil(*observation, random, Sizes::changed);
    Arrived arrived;
    arrived.observation = observation;
    arrived.role = role_of(*observation);
    arrived.is_hurried = random.one_in(20);
    arrived.is_late = random.one_in(20);
    ++num_in;
    note(upsampling.feed(arrived));
  }
  note(upsampling.finish());
  if (num_out < num_in) throw Finding("an observation does not come out live");
}

}  // namespace

std::vector<Target> log_targets() {
  std::vector<Target> targets;
  for (const LogSeed& seed : log_seeds())
    targets.push_back({seed.name, [&seed](Random& random) { run_log(seed, random); },
                       [&seed] { run_whole_log(seed); }, 12});
  targets.push_back({"live", [](Random& random) { run_live(random, true); },
                     [] {
                       Random random(1);
                       run_live(random, false);
                     },
                     50});
  return targets;
}

}  // namespace lidar_upsampling::fuzz
