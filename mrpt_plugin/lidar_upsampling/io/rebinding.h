// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <vector>

namespace lidar_upsampling {

/// @return the function of this name that the process calls; null: there is none.
/// @param symbol its name for the linker.
[[nodiscard]] void* function_named(const char* symbol);

/// Another function of the same type for an exported one.
struct Rebinding {
  const char* symbol;  ///< its name for the linker
  void* replacement;
};

/// @brief Sends the calls of exported functions, by whatever part of this process is loaded, to
/// others. Does nothing on machines other than x86-64 and AArch64.
/// A program could define the function itself, and be linked before the library that has it. A
/// module comes too late for this: the libraries that call it are bound already. Both have the
/// addresses to be called in tables of the ELF format, which are written here. All in one call:
/// each walks through the tables of some two hundred libraries.
void rebind(const std::vector<Rebinding>& changes);

}  // namespace lidar_upsampling
