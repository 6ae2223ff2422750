// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

namespace lidar_upsampling {

/// @return the function of this name that the process calls; null: there is none.
/// @param symbol its name for the linker.
[[nodiscard]] void* function_named(const char* symbol);

/// @brief Sends the calls of an exported function, by whatever part of this process is loaded, to
/// another one of the same type. Does nothing on machines other than x86-64 and AArch64.
/// A program could define the function itself, and be linked before the library that has it. A
/// module comes too late for this: the libraries that call it are bound already. Both have the
/// addresses to be called in tables of the ELF format, which are written here.
void rebind(const char* symbol, void* replacement);

}  // namespace lidar_upsampling
