// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors

// Thins one sensor of a log: keeps every K-th of its observations or none, and all else byte for
// byte.
#include <mrpt/obs/CObservation.h>
#include <mrpt/obs/CSensoryFrame.h>

#include <algorithm>
#include <iostream>
#include <set>

#include "common/tool_main.h"
#include "lidar_upsampling/io/file_places.h"
#include "lidar_upsampling/io/rawlog_stream.h"
#include "lidar_upsampling/io/sensory_frame.h"

namespace lidar_upsampling {
namespace {

struct Options {
  std::string input;
  std::string output;
  std::string label;
  std::size_t keep_every = 1;
  std::size_t offset = 0;
  bool overwrite = false, accept_truncated = false;
};

class Decimator {
 public:
  explicit Decimator(const Options& options) : options_(options) {}

  /// What is left of an entry of the log, none if nothing.
  std::optional<RawlogEntry> operator()(RawlogEntry entry) {
    if (const auto* const frame =
            dynamic_cast<const mrpt::obs::CSensoryFrame*>(entry.object.get())) {
      return keep_in_frame(*frame) ? std::move(entry) : thinned(entry);
    }
    const auto* const observation =
        dynamic_cast<const mrpt::obs::CObservation*>(entry.object.get());
    if (observation != nullptr && !keep(*observation)) return std::nullopt;
    return entry;
  }

  [[nodiscard]] std::size_t num_seen() const { return num_seen_; }
  [[nodiscard]] std::size_t num_kept() const { return num_kept_; }
  [[nodiscard]] const std::set<std::string>& labels() const { return labels_; }

 private:
  bool keep(const mrpt::obs::CObservation& observation) {
    labels_.insert(observation.sensorLabel);
    if (observation.sensorLabel != options_.label) return true;
    const std::size_t index = num_seen_++;
    const bool kept = options_.keep_every > 0 && index >= options_.offset &&
                      (index - options_.offset) % options_.keep_every == 0;
    num_kept_ += kept ? 1 : 0;
    return kept;
  }

  // Fills keep_ for each observation of the frame; whether all of them stay.
  bool keep_in_frame(const mrpt::obs::CSensoryFrame& frame) {
    keep_.clear();
    for (const auto& observation : frame) keep_.push_back(keep(*observation));
    return std::all_of(keep_.begin(), keep_.end(), [](bool kept) { return kept; });
  }

  [[nodiscard]] RawlogEntry thinned(const RawlogEntry& frame) const {
    std::vector<RawlogEntry> left;
    std::size_t index = 0;
    for (RawlogEntry& observation : split_frame(frame)) {
      if (keep_[index++]) left.push_back(std::move(observation));
    }
    return join_frame(left);  // even if empty: frames come in pairs with actions
  }

  const Options& options_;
  std::vector<bool> keep_;
  std::size_t num_seen_ = 0;
  std::size_t num_kept_ = 0;
  std::set<std::string> labels_;
};

std::string joined(const std::set<std::string>& labels) {
  std::string text;
  for (const std::string& label : labels) text += (text.empty() ? "'" : ", '") + label + "'";
  return text.empty() ? "none" : text;
}

void decimate(const Options& options) {
  const FileUse output{"--output", options.output};
  check_files({{"--input", options.input}}, {output});
  const double share = options.keep_every > 0 ? 1. / static_cast<double>(options.keep_every) : 0;
  check_room(output, options.input, false, share);
  RawlogReader reader({options.input, options.accept_truncated});
  RawlogWriter writer(options.output, options.overwrite);
  Decimator decimator(options);
  {
    Progress progress("decimating");
    while (auto entry = reader.next()) {
      if (const auto left = decimator(std::move(*entry))) writer.write(*left);
      progress(reader.progress());
    }
  }
  if (decimator.num_seen() == 0) {
    throw std::runtime_error("no observation in " + options.input + " has the label '" +
                             options.label + "'; there are: " + joined(decimator.labels()));
  }
  writer.commit();
  if (reader.damage()) warn("rawlog-decimate", *reader.damage());
  if (!share_external_storage(options.input, options.output))
    warn("rawlog-decimate", "the external files are not linked: " +
                                external_storage_of(options.output) + " is something else");
  std::cout << "kept " << decimator.num_kept() << " of " << decimator.num_seen() << " of '"
            << options.label << "', " << writer.num_written() << " objects in " << options.output
            << "\n";
}

}  // namespace
}  // namespace lidar_upsampling

int main(int argc, char** argv) {
  lidar_upsampling::Options options;
  CLI::App app("Keeps every K-th observation of one sensor or none, and all else untouched.",
               "rawlog-decimate");
  app.add_option("input,-i,--input", options.input, "The log to thin")->required();
  app.add_option("-o,--output", options.output, "The log to write")->required();
  app.add_option("--label", options.label, "The sensor to thin")->required();
  app.add_option("--keep-every", options.keep_every,
                 "K: of K observations one is kept; of 0, none is")
      ->required()
      ->check(CLI::Range(0, 1000000));
  app.add_option("--offset", options.offset, "Number of the first one that is kept, from 0")
      ->capture_default_str()
      ->check(CLI::Range(0, 1000000000));
  app.add_flag("--overwrite", options.overwrite, "Replace an existing output");
  app.add_flag("--accept-truncated", options.accept_truncated,
               "Of a damaged log, take all that can be read, before and behind the damage");
  app.footer(
      "Examples:\n  rawlog-decimate -i full.rawlog -o sparse.rawlog --label LIDAR --keep-every 2");
  return lidar_upsampling::run_tool(app, argc, argv, [&] { lidar_upsampling::decimate(options); });
}
