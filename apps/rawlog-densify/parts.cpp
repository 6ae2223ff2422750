// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "parts.h"

#include <mrpt/img/CImage.h>
#include <tbb/info.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <deque>
#include <exception>
#include <memory>
#include <stdexcept>
#include <thread>
#include <utility>

#include "ego_ahead.h"
#include "lidar_upsampling/front_end/pose_input.h"
#include "lidar_upsampling/io/file_places.h"
#include "lidar_upsampling/io/output_file.h"
#include "lidar_upsampling/io/packed_writer.h"
#include "mrpt_needs.h"
#include "odd_inputs.h"
#include "streams.h"

namespace lidar_upsampling {
namespace {

bool is_one_frame(const Compression& compression) {
  return compression.format == Compression::Format::zstd;
}

/// The parts' outputs until they are one: gzip files one after the other are a gzip file; for zstd,
/// which has to be one frame, they are packed when they are joined.
class PartFiles {
 public:
  PartFiles(const DensifyJob& job, std::size_t count)
      : output_(job.output, {job.overwrite}), compression_(job.config.compression) {
    for (std::size_t i = is_one_frame(compression_) ? 0 : 1; i < count; ++i)
      others_.push_back(OutputFile::scratch(job.output));
  }

  [[nodiscard]] OutputFile& file(std::size_t part) {
    if (is_one_frame(compression_)) return others_[part];
    return part == 0 ? output_ : others_[part - 1];
  }

  void join() {
    if (is_one_frame(compression_)) pack();
    for (; !others_.empty(); others_.pop_front()) output_.append(others_.front());
    output_.commit();
  }

 private:
  void pack() {
    PackedWriter writer(output_, compression_);
    for (; !others_.empty(); others_.pop_front())
      for (std::uint64_t done = 0; done < others_.front().size();) {
        std::vector<std::uint8_t> block(1U << 20U);
        block.resize(others_.front().read(done, block.data(), block.size()));
        if (block.empty()) throw std::runtime_error(output_.path() + ": a part of it is gone");
        done += block.size();
        writer.write(block);
      }
    writer.finish();
  }

  OutputFile output_;
  Compression compression_;
  std::deque<OutputFile> others_;
};

// Parts begin at real scans, of which each has as many.
std::vector<LogPart> parts_of(const LogIndex& index, std::vector<Stamp> scans,
                              const PartOptions& options) {
  std::sort(scans.begin(), scans.end());
  const double length_s = seconds_between(scans.front(), scans.back());
  const auto useful = static_cast<std::size_t>(length_s / std::max(1., options.warm_up_s));
  std::vector<LogPart> parts(std::clamp<std::size_t>(useful, 1, options.most));
  for (std::size_t i = 0; i < parts.size(); ++i) {
    parts[i].index = &index;
    parts[i].warm_up_s = options.warm_up_s;
    if (i > 0) parts[i].from = parts[i - 1].to = scans[i * scans.size() / parts.size()];
  }
  return parts;
}

// Side by side, each with its share of the cores.
std::vector<PartReport> densify_side_by_side(DensifyJob job, const std::vector<LogPart>& parts,
                                             PartFiles& files,
                                             const std::function<void(double)>& progress) {
  if (is_one_frame(job.config.compression)) job.config.compression = Compression::none;
  const int cores = std::max(1, tbb::info::default_concurrency() / static_cast<int>(parts.size()));
  std::vector<PartReport> reports(parts.size());
  std::vector<std::exception_ptr> errors(parts.size());
  const auto work = [&](std::size_t i) {
    try {
      tbb::task_arena(cores).execute([&] {
        // The last part reads the most.
        reports[i] =
            densify_part(job, parts[i], files.file(i), i + 1 == parts.size() ? progress : nullptr);
      });
    } catch (...) {
      errors[i] = std::current_exception();
    }
  };
  std::vector<std::thread> threads;
  for (std::size_t i = 0; i < parts.size(); ++i) threads.emplace_back(work, i);
  for (std::thread& thread : threads) thread.join();
  for (const std::exception_ptr& error : errors)
    if (error) std::rethrow_exception(error);
  return reports;
}

}  // namespace

DensifyReport densify_in_parts(const DensifyJob& job, const PartOptions& options,
                               const std::function<void(double)>& progress) {
  if (!job.pictures.empty() || !job.film.empty())
    throw std::runtime_error(
        "--pictures and --film are drawn from the log's begin to its end: with one input "
        "they need --jobs 1");
  // Whether it can be written is told before the work.
  static_cast<void>(output_place(job.output, job.overwrite));
  mrpt::img::CImage::DISABLE_JPEG_COMPRESSION(true);  // of the process: not once per writer
  LogIndex index = index_streams({job.input, job.accept_truncated});
  const bool goes_by = ego_goes_by(job.config, index);
  if (!goes_by) index = index_log({job.input, job.accept_truncated});
  take_poses_from_file(job.config, job.rig, index);
  const auto streams = select_streams(index, job.config, labels_of_calibrated(job.rig));
  std::vector<LogPart> parts = parts_of(index, streams.lidar->stamps, options);
  for (LogPart& part : parts) part.ego_goes_by = goes_by;
  PartFiles files(job, parts.size());
  std::shared_ptr<ReportRows> rows;
  if (!job.rows_beside.empty()) rows = std::make_shared<ReportRows>(job.rows_beside);
  DensifyReport report = joined(densify_side_by_side(job, parts, files, progress), rows);
  files.join();
  warn_of_nothing_made(job, report);
  warn_of_newer_mrpt(job.config, report);
  link_external_images(job, report);
  return report;
}

}  // namespace lidar_upsampling
