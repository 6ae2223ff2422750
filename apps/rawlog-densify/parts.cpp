// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "parts.h"

#include <mrpt/img/CImage.h>
#include <tbb/info.h>
#include <tbb/task_arena.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <exception>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>
#include <system_error>
#include <thread>
#include <utility>

#include "lidar_upsampling/front_end/pose_input.h"
#include "lidar_upsampling/io/rawlog_stream.h"
#include "streams.h"

namespace fs = std::filesystem;

namespace lidar_upsampling {
namespace {

/// The parts' outputs until they are one.
class PartFiles {
 public:
  // @param output through symbolic links, so that these are kept
  PartFiles(const std::string& output, std::size_t count)
      : output_(fs::exists(output) ? fs::canonical(output).string() : output) {
    for (std::size_t i = 0; i < count; ++i)
      paths_.push_back(output_ + ".part-" + std::to_string(getpid()) + "-" + std::to_string(i));
  }
  ~PartFiles() {
    std::error_code ignored;
    for (const std::string& path : paths_) fs::remove(path, ignored);
  }
  PartFiles(const PartFiles&) = delete;
  PartFiles& operator=(const PartFiles&) = delete;

  [[nodiscard]] const std::string& path(std::size_t part) const { return paths_[part]; }

  // Packed files one after the other are a packed file.
  void join(bool overwrite) {
    std::ofstream all(paths_.front(), std::ios::binary | std::ios::app);
    for (std::size_t i = 1; i < paths_.size(); ++i) {
      std::ifstream part(paths_[i], std::ios::binary);
      all << part.rdbuf();
      all.flush();
      if (!all || !part)
        throw std::runtime_error(output_ +
                                 ": cannot be written: " + std::generic_category().message(errno));
      fs::remove(paths_[i]);
    }
    all.close();
    if (!overwrite && fs::exists(output_))
      throw std::runtime_error(output_ + " exists: pass --overwrite to replace it");
    fs::rename(paths_.front(), output_);
  }

 private:
  std::string output_;
  std::vector<std::string> paths_;
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
std::vector<PartReport> densify_side_by_side(const DensifyJob& job,
                                             const std::vector<LogPart>& parts,
                                             const PartFiles& files,
                                             const std::function<void(double)>& progress) {
  const int cores = std::max(1, tbb::info::default_concurrency() / static_cast<int>(parts.size()));
  std::vector<PartReport> reports(parts.size());
  std::vector<std::exception_ptr> errors(parts.size());
  const auto work = [&](std::size_t i) {
    try {
      DensifyJob own = job;
      own.output = files.path(i);
      own.keep_rows = true;  // by which the parts' tracks are told to be the same
      tbb::task_arena(cores).execute([&] {
        // The last part reads the most.
        reports[i] = densify_part(own, parts[i], i + 1 == parts.size() ? progress : nullptr);
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
  static_cast<void>(RawlogWriter(job.output, job.overwrite));
  mrpt::img::CImage::DISABLE_JPEG_COMPRESSION(true);  // of the process: not once per writer
  LogIndex index = index_log({job.input, job.accept_truncated});
  take_poses_from_file(job.config, job.rig, index);
  const auto streams = select_streams(index, job.config, labels_of_calibrated(job.rig));
  const std::vector<LogPart> parts = parts_of(index, streams.lidar->stamps, options);
  PartFiles files(job.output, parts.size());
  DensifyReport report = joined(densify_side_by_side(job, parts, files, progress));
  files.join(job.overwrite);
  report.output = job.output;
  if (!job.keep_rows) {
    report.rows.clear();
    report.other_clusters.clear();
  }
  link_external_images(job, report);
  return report;
}

}  // namespace lidar_upsampling
