// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "many_logs.h"

#include <filesystem>
#include <iostream>
#include <set>
#include <stdexcept>
#include <system_error>
#include <utility>

#include "lidar_upsampling/io/file_places.h"
#include "processes.h"

namespace fs = std::filesystem;

namespace lidar_upsampling {

std::vector<LogJob> jobs_of(const std::vector<std::string>& inputs, const DensifyJob& job,
                            const std::string& report) {
  if (!fs::is_directory(job.output))
    throw std::runtime_error("--output " + job.output +
                             ": of several inputs it is to be a folder that is there");
  std::set<std::string> stems;
  std::vector<LogJob> jobs;
  for (const std::string& input : inputs) {
    const fs::path name = fs::path(input).filename();
    const std::string stem = name.stem().string();
    if (!stems.insert(stem).second)
      throw std::runtime_error(input + ": another input is called " + stem +
                               ", too; their outputs would be one");
    std::error_code ignored;
    if (fs::equivalent(fs::absolute(input).parent_path(), job.output, ignored))
      throw std::runtime_error(input + ": its output would be itself, as it lies in --output");
    LogJob one{job, {}};
    one.job.input = input;
    one.job.output = (fs::path(job.output) / name).string();
    if (!job.pictures.empty()) one.job.pictures = (fs::path(job.pictures) / stem).string();
    if (!job.film.empty()) one.job.film = (fs::path(job.film) / (stem + ".mp4")).string();
    if (!report.empty()) one.report = (fs::path(report) / (stem + ".json")).string();
    jobs.push_back(std::move(one));
  }
  if (!report.empty()) fs::create_directories(report);
  for (const std::string& folder : {job.pictures, job.film})
    if (!folder.empty()) fs::create_directories(folder);
  for (const LogJob& one : jobs)
    for (const std::string& input : inputs)
      check_files({{"--input", input}}, {{"--output", one.job.output}, {"--report", one.report}});
  return jobs;
}

void densify_all(const std::vector<LogJob>& jobs, std::size_t at_once,
                 const std::function<std::string(const LogJob&)>& densify_one,
                 const std::function<void(double)>& progress) {
  std::vector<std::function<std::string()>> work;
  work.reserve(jobs.size());
  for (const LogJob& job : jobs) work.emplace_back([&] { return densify_one(job); });
  std::size_t num_done = 0;
  std::string failures;
  std::size_t num_failed = 0;
  const auto ended = [&](std::size_t number, const Ending& ending) {
    progress(static_cast<double>(++num_done) / static_cast<double>(jobs.size()));
    const DensifyJob& job = jobs[number].job;
    std::cout << (ending.failed ? job.input + ": failed" : job.output) << '\n'
              << ending.text << std::endl;
  };
  const std::vector<Ending> endings = run_in_processes(work, at_once, ended);
  for (std::size_t i = 0; i < endings.size(); ++i) {
    if (!endings[i].failed) continue;
    ++num_failed;
    const std::string& input = jobs[i].job.input;
    const bool is_named = endings[i].text.find(input) != std::string::npos;
    failures += "; " + (is_named ? "" : input + ": ") + endings[i].text;
  }
  if (num_failed > 0)
    throw std::runtime_error(std::to_string(num_failed) + " of " + std::to_string(jobs.size()) +
                             " logs have failed" + failures);
}

}  // namespace lidar_upsampling
