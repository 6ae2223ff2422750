// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <functional>
#include <string>
#include <vector>

namespace lidar_upsampling {

/// How a process of its own has ended.
struct Ending {
  bool failed = false;
  std::string text;  ///< what the work returned, or what is wrong
};

/// @brief Does each piece of work in a process of its own, `at_once` at a time, each with its share
/// of the cores. None may have been used for parallel work by this process before.
/// @param work returns a text, or throws. @param ended is called with a piece's number as it ends.
/// @return how each has ended. @throw std::system_error no more processes are to be had.
std::vector<Ending> run_in_processes(const std::vector<std::function<std::string()>>& work,
                                     std::size_t at_once,
                                     const std::function<void(std::size_t, const Ending&)>& ended);

}  // namespace lidar_upsampling
