// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <filesystem>
#include <random>
#include <set>
#include <thread>

#include "hand_made_log.h"
#include "io/small_logs.h"
#include "pipeline.h"

namespace fs = std::filesystem;

namespace lidar_upsampling {
namespace {

using Seconds = std::chrono::duration<double>;

std::set<std::string> names_in(const fs::path& folder) {
  std::set<std::string> names;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    names.insert(fs::relative(entry.path(), folder).string());
  return names;
}

/// Starts a command in a process of its own, sends a signal after a while, and waits.
/// @return what waitpid() tells.
int interrupted(const std::string& command, Seconds after, int signal) {
  const std::string shell = "exec " + command + " > /dev/null 2>&1";
  const pid_t process = fork();
  if (process == 0) {
    execl("/bin/sh", "sh", "-c", shell.c_str(), nullptr);
    _exit(127);
  }
  std::this_thread::sleep_for(after);
  kill(process, signal);
  int status = 0;
  waitpid(process, &status, 0);
  return status;
}

/// A command that is killed again and again. Its output is in the folder `out`.
class Interrupted {
 public:
  Interrupted(const TestFolder& folder, std::string command)
      : folder_(folder.path()), command_(std::move(command)) {
    const auto start = std::chrono::steady_clock::now();
    expect_done(command_);
    whole_run_ = std::chrono::steady_clock::now() - start;
    names_ = names_in(folder_);
    for (const std::string& name : names_)
      if (fs::is_regular_file(folder_ / name)) whole_[name] = file_bytes((folder_ / name).string());
  }

  /// @param may_differ files that tell of times: they are to be as long as JSON is, not the same.
  void expect_whole_files(int times, const std::set<std::string>& may_differ = {}) {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> share(0, 1.1);
    constexpr std::array<int, 4> kSignals{SIGTERM, SIGKILL, SIGINT, SIGHUP};
    for (int i = 0; i < times; ++i) {
      const int signal = kSignals.at(static_cast<std::size_t>(i) % kSignals.size());
      const int status = interrupted(command_, share(random) * whole_run_, signal);
      EXPECT_EQ(WIFSIGNALED(status) ? WTERMSIG(status) : WEXITSTATUS(status),
                WIFSIGNALED(status) ? signal : 0);
      if (signal != SIGKILL) {
        EXPECT_EQ(names_in(folder_), names_) << "after signal " << signal;
      }
      expect_whole(may_differ);
    }
    expect_done(command_);
    EXPECT_EQ(names_in(folder_), names_);
  }

 private:
  void expect_whole(const std::set<std::string>& may_differ) {
    for (const auto& [name, bytes] : whole_) {
      const Bytes now = file_bytes((folder_ / name).string());
      const bool is_whole = may_differ.count(name) == 0
                                ? now == bytes
                                : nlohmann::json::accept(now.begin(), now.end());
      EXPECT_TRUE(is_whole) << name;
    }
  }

  fs::path folder_;
  std::string command_;
  Seconds whole_run_{};
  std::set<std::string> names_;
  std::map<std::string, Bytes> whole_;
};

TEST(Interrupted, densifying_leaves_the_old_files_or_the_new_ones_and_no_others) {
  const TestFolder folder;
  HandMadeLog log;
  log.num_images = log.num_instants = 24;
  write_hand_made(folder / "in.rawlog", log);
  Interrupted(folder, densify_command(folder / "in.rawlog", folder / "out.rawlog",
                                      "--overwrite --report " + folder / "out.json" +
                                          " --pictures " + folder / "pictures"))
      .expect_whole_files(12, {"out.json"});
}

TEST(Interrupted, parts_of_a_log_likewise) {
  const TestFolder folder;
  HandMadeLog log;
  log.num_images = log.num_instants = 130;
  write_hand_made(folder / "a.rawlog", log);
  Interrupted(folder, densify_command(folder / "a.rawlog", folder / "out.rawlog",
                                      "--overwrite --jobs 2 --warm-up 1"))
      .expect_whole_files(8);
}

TEST(Interrupted, thinning_and_exporting_likewise) {
  const TestFolder folder;
  HandMadeLog log;
  log.num_images = log.num_instants = 40;
  write_hand_made(folder / "in.rawlog", log);
  Interrupted(folder, std::string(RAWLOG_DECIMATE) + " --input " + folder / "in.rawlog" +
                          " --output " + folder / "out.rawlog" +
                          " --label LIDAR --keep-every 2 --overwrite")
      .expect_whole_files(8);
  Interrupted(folder, std::string(RAWLOG_EXPORT) + " --input " + folder / "in.rawlog" +
                          " --label LIDAR --output " + folder / "export --overwrite")
      .expect_whole_files(8);
}

TEST(Interrupted, a_name_that_a_killed_run_of_the_same_number_left_is_no_obstacle) {
  const TestFolder folder;
  write_hand_made(folder / "in.rawlog");
  std::ofstream(folder / "out.rawlog.tmp-0123456789ab") << "left";
  densify(folder);
  EXPECT_EQ(names_in(folder.path()), (std::set<std::string>{"in.rawlog", "out.rawlog"}));
}

TEST(Interrupted, an_ignored_signal_stays_ignored) {
  const TestFolder folder;
  write_hand_made(folder / "in.rawlog");
  expect_done("trap '' HUP; " + densify_command(folder / "in.rawlog", folder / "out.rawlog") +
              " & process=$!; sleep 0.05; kill -HUP $process; wait $process");
}

}  // namespace
}  // namespace lidar_upsampling
