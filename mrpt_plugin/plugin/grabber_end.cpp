// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "plugin/grabber_end.h"

#include <cstdint>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <system_error>
#include <vector>

#include "lidar_upsampling/io/rebinding.h"
#include "lidar_upsampling/io/unpacker.h"

namespace lidar_upsampling {
namespace {

bool is_grabber() { return function_named("_ZN4mrpt4apps16RawlogGrabberApp7runImplEv") != nullptr; }

bool pressed() noexcept { return true; }

std::string& doubtful_recording() {
  static std::string path;
  return path;
}

bool holds_nothing(const std::string& path) {
  std::vector<std::uint8_t> block(1);
  return Unpacker(path).unpack(block) == 0;
}

void remove_if_empty() {
  const std::string& path = doubtful_recording();
  std::error_code ignored;
  try {
    if (holds_nothing(path)) std::filesystem::remove(path, ignored);
  } catch (const std::exception&) {  // it was not made
  }
}

}  // namespace

bool press_key_in_grabber() {
  if (!is_grabber()) return false;
  rebind({{"_ZN4mrpt6system2os5kbhitEv", reinterpret_cast<void*>(pressed)}});
  return true;
}

std::string recording_of(const std::string& external_images) {
  const std::string ending = "_Images";
  const std::size_t size = external_images.size();
  if (size <= ending.size() || external_images.substr(size - ending.size()) != ending) return {};
  return external_images.substr(0, size - ending.size()) + ".rawlog";
}

void remove_empty_recording_at_exit(const std::string& external_images) {
  const std::string recording = recording_of(external_images);
  if (recording.empty() || !is_grabber()) return;
  static const bool registered = [] {
    doubtful_recording();  // outlives what is registered after it
    return std::atexit(remove_if_empty) == 0;
  }();
  static_cast<void>(registered);
  doubtful_recording() = recording;
}

}  // namespace lidar_upsampling
