// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/io/silence.h"

#include <gtest/gtest.h>

#include <iostream>
#include <thread>

namespace lidar_upsampling {
namespace {

TEST(Silence, takes_what_its_own_thread_prints_as_long_as_it_lives) {
  testing::internal::CaptureStderr();
  {
    const Silence silence;
    std::cerr << "lost " << 1 << std::endl;
    { const Silence within; }
    std::cerr << "lost" << std::flush;
    std::thread([] { std::cerr << "another's " << 2 << '\n'; }).join();
  }
  std::cerr << "kept" << std::endl;
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "another's 2\nkept\n");
}

}  // namespace
}  // namespace lidar_upsampling
