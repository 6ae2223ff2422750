// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "densify.h"

#include <mrpt/obs/CSensoryFrame.h>

#include <optional>
#include <utility>
#include <vector>

#include "densification.h"
#include "lidar_upsampling/front_end/virtual_observations.h"
#include "lidar_upsampling/io/rawlog_stream.h"
#include "lidar_upsampling/io/sensory_frame.h"
#include "log_input.h"
#include "mrpt_needs.h"
#include "odd_inputs.h"

namespace lidar_upsampling {
namespace {

using mrpt::obs::CObservation;

// What goes out around one observation of the log.
struct Neighbours {
  std::vector<CObservation::Ptr> before, after;
};

/// Virtual scans as observations beside those of the log.
class Insertion {
 public:
  Insertion(const DensifyJob& job, const LogIndex& index, DensifyReport& report)
      : report_(report), config_(job.config), run_(job, index, report) {}

  Neighbours feed(const CObservation::Ptr& observation) {
    Neighbours result;
    if (const auto scan = run_.feed(observation)) {
      auto& side = scan->scan.stamp < observation->timestamp ? result.before : result.after;
      side = out(*scan);
    }
    return result;
  }

  std::vector<CObservation::Ptr> flush() {
    const auto scan = run_.flush();
    if (!scan) return {};
    return out(*scan);
  }

  [[nodiscard]] Densification& run() { return run_; }

 private:
  std::vector<CObservation::Ptr> out(const VirtualScan& scan) {
    const Timed packing(report_, "packing");
    auto observations = virtual_observations(scan, config_, *run_.last_real());
    if (report_.carrier.empty())
      report_.carrier = observations.front()->GetRuntimeClass()->className;
    return observations;
  }

  DensifyReport& report_;
  const Config& config_;
  Densification run_;
};

// Virtual scans go inside the frame that holds their image: MRPT's apps drop bare observations
// there.
RawlogEntry densified_frame(const RawlogEntry& frame, Insertion& run) {
  std::vector<RawlogEntry> observations;
  bool changed = false;
  const auto add = [&](const CObservation::Ptr& observation) {
    observations.push_back(entry_of(observation));
    changed = true;
  };
  for (RawlogEntry& entry : split_frame(frame)) {
    const auto around = run.feed(std::dynamic_pointer_cast<CObservation>(entry.object));
    for (const auto& observation : around.before) add(observation);
    observations.push_back(std::move(entry));
    for (const auto& observation : around.after) add(observation);
  }
  for (const auto& observation : run.flush()) add(observation);
  return changed ? join_frame(observations) : frame;
}

/// The output log; the time that it takes goes into the report.
class Output {
 public:
  Output(const DensifyJob& job, OutputFile& file, DensifyReport& report)
      : report_(report), writer_(file, job.config.compression) {}

  template <typename Object>
  void write(const Object& object) {
    const Timed writing(report_, "writing");
    writer_.write(object);
  }
  void finish() { writer_.finish(); }

 private:
  DensifyReport& report_;
  RawlogWriter writer_;
};

void densify_entry(const RawlogEntry& entry, Insertion& run, Output& output) {
  if (dynamic_cast<mrpt::obs::CSensoryFrame*>(entry.object.get()) != nullptr) {
    output.write(densified_frame(entry, run));
    return;
  }
  const auto around = run.feed(std::dynamic_pointer_cast<CObservation>(entry.object));
  for (const auto& observation : around.before) output.write(*observation);
  output.write(entry);
  for (const auto& observation : around.after) output.write(*observation);
}

std::string detector_name(const Config& config) {
  switch (config.detector.type) {
    case DetectorOptions::Type::network:
      return "network " + config.detector.network.model;
    case DetectorOptions::Type::csv:
      return "boxes from " + config.detector.csv.path;
    case DetectorOptions::Type::clusters:
      break;
  }
  return "clusters of the scan";
}

DensifyReport report_of(const DensifyJob& job) {
  DensifyReport report;
  report.input = job.input;
  report.output = job.output;
  report.mode = job.config.mode;
  report.hindsight = job.config.mode == "offline";
  report.detector = detector_name(job.config);
  return report;
}

// Nothing of it goes out.
void warm_up(Densification& run, LogInput& input, const LogPart& part) {
  input.skip_to(shifted(*part.from, -part.warm_up_s));
  while (const auto entry = input.next(run, part.from)) {
    if (const auto* frame = dynamic_cast<const mrpt::obs::CSensoryFrame*>(entry->object.get()))
      for (const CObservation::Ptr& observation : *frame) static_cast<void>(run.feed(observation));
    else
      static_cast<void>(run.feed(std::dynamic_pointer_cast<CObservation>(entry->object)));
  }
  static_cast<void>(run.flush());
}

std::shared_ptr<ReportRows> rows_for(const DensifyJob& job) {
  return job.rows_beside.empty() ? nullptr : std::make_shared<ReportRows>(job.rows_beside);
}

PartReport attempt(const DensifyJob& job, const LogPart& part, OutputFile& file, bool know_all,
                   const std::function<void(double)>& progress) {
  constexpr double kIndexShare = 0.1;  // of the whole work, where there is need of one
  PartReport done{report_of(job), {}};
  DensifyReport& report = done.report;
  Output output(job, file, report);
  LogInput input(job, report);
  double told = 0;
  const auto tell = [&](double share) {
    told = share;
    if (progress) progress(share);
  };
  if (part.index != nullptr) input.know_all(*part.index, part.ego_goes_by);
  const LogIndex index =
      part.index != nullptr
          ? *part.index
          : input.index(know_all, [&](double share) { tell(kIndexShare * share); });
  const double before = told;
  Insertion run(job, index, report);
  if (part.from) {
    warm_up(run.run(), input, part);
    done.warm_up = std::exchange(report, report.begun_anew());
  }
  report.rows = rows_for(job);
  for (; const auto entry = input.next(run.run(), part.to); ++report.num_objects_in) {
    densify_entry(*entry, run, output);
    tell(before + (1 - before) * input.progress());
  }
  for (const auto& observation : run.flush()) output.write(*observation);
  if (!part.to) run.run().finish();
  output.finish();
  return done;
}

}  // namespace

PartReport densify_part(const DensifyJob& job, const LogPart& part, OutputFile& output,
                        const std::function<void(double)>& progress) {
  try {
    return attempt(job, part, output, false, progress);
  } catch (const EgoComesLate&) {
    output.clear();
    return attempt(job, part, output, true, progress);
  }
}

DensifyReport densify(const DensifyJob& job, const std::function<void(double)>& progress) {
  OutputFile output(job.output, {job.overwrite});
  DensifyReport report = densify_part(job, {}, output, progress).report;
  {
    const Timed writing(report, "writing");
    output.commit();
  }
  warn_of_nothing_made(job, report);
  warn_of_newer_mrpt(job.config, report);
  link_external_images(job, report);
  return report;
}

void link_external_images(const DensifyJob& job, DensifyReport& report) {
  if (!share_external_storage(job.input, job.output))
    report.warn(
        "the output's folder of external images is taken by something else: its images will not be "
        "found");
}

}  // namespace lidar_upsampling
