// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "processes.h"

#include <poll.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <tbb/global_control.h>
#include <tbb/info.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <exception>
#include <map>
#include <opencv2/core/utility.hpp>
#include <system_error>

#include "lidar_upsampling/text.h"

namespace lidar_upsampling {
namespace {

struct Child {
  std::size_t number = 0;
  pid_t process = 0;
  std::string text;
};

void write_all(int file, const std::string& text) {
  for (std::size_t done = 0; done < text.size();) {
    const ssize_t step = ::write(file, text.data() + done, text.size() - done);
    if (step < 0 && errno != EINTR) return;
    done += static_cast<std::size_t>(std::max<ssize_t>(0, step));
  }
}

// Never returns: what this process inherited is not its to clear up.
[[noreturn]] void be_child(const std::function<std::string()>& work, int file, int cores) {
  int status = 0;
  std::string text;
  try {
    const tbb::global_control share(tbb::global_control::max_allowed_parallelism,
                                    static_cast<std::size_t>(cores));
    cv::setNumThreads(cores);
    text = work();
  } catch (const std::exception& error) {
    status = 1;
    text = one_line(error);
  }
  write_all(file, text);
  std::fflush(nullptr);
  _exit(status);
}

/// The children under way, by the pipe that each writes to.
class Children {
 public:
  void start(std::size_t number, const std::function<std::string()>& work, int cores) {
    std::array<int, 2> ends{};
    if (pipe(ends.data()) != 0) throw std::system_error(errno, std::generic_category(), "pipe");
    std::fflush(nullptr);  // else the child would write it, too
    const pid_t parent = getpid();
    const pid_t process = fork();
    if (process < 0) throw std::system_error(errno, std::generic_category(), "fork");
    if (process == 0) {
      prctl(PR_SET_PDEATHSIG, SIGTERM);  // not to go on alone
      if (getppid() != parent) _exit(1);
      close(ends[0]);
      be_child(work, ends[1], cores);
    }
    close(ends[1]);
    children_[ends[0]] = {number, process, {}};
  }

  [[nodiscard]] std::size_t size() const { return children_.size(); }

  /// Waits for one to end. @return its number
  std::size_t wait(std::vector<Ending>& endings) {
    for (;;) {
      std::vector<pollfd> polled;
      for (const auto& [file, child] : children_) polled.push_back({file, POLLIN, 0});
      if (poll(polled.data(), polled.size(), -1) < 0) continue;
      for (const pollfd& each : polled)
        if (each.revents != 0 && !read_some(each.fd)) return end(each.fd, endings);
    }
  }

 private:
  bool read_some(int file) {
    std::array<char, 4096> buffer{};
    const ssize_t step = read(file, buffer.data(), buffer.size());
    if (step > 0) children_.at(file).text.append(buffer.data(), static_cast<std::size_t>(step));
    return step > 0 || (step < 0 && errno == EINTR);
  }

  std::size_t end(int file, std::vector<Ending>& endings) {
    const Child child = std::move(children_.extract(file).mapped());
    close(file);
    int status = 0;
    while (waitpid(child.process, &status, 0) < 0 && errno == EINTR) continue;
    Ending& ending = endings[child.number];
    ending.failed = !WIFEXITED(status) || WEXITSTATUS(status) != 0;
    ending.text = child.text;
    if (WIFSIGNALED(status)) ending.text = "ended by signal " + std::to_string(WTERMSIG(status));
    return child.number;
  }

  std::map<int, Child> children_;
};

}  // namespace

std::vector<Ending> run_in_processes(const std::vector<std::function<std::string()>>& work,
                                     std::size_t at_once,
                                     const std::function<void(std::size_t, const Ending&)>& ended) {
  at_once = std::clamp<std::size_t>(at_once, 1, std::max<std::size_t>(1, work.size()));
  const int cores = std::max(1, tbb::info::default_concurrency() / static_cast<int>(at_once));
  std::vector<Ending> endings(work.size());
  Children children;
  for (std::size_t next = 0; next < work.size() || children.size() > 0;) {
    if (next < work.size() && children.size() < at_once) {
      children.start(next, work[next], cores);
      ++next;
      continue;
    }
    const std::size_t number = children.wait(endings);
    ended(number, endings[number]);
  }
  return endings;
}

}  // namespace lidar_upsampling
