// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include <exception>
#include <filesystem>
#include <iostream>

#include "importers/argoverse_layout.h"
#include "importers/dgp_layout.h"
#include "importers/kitti_layouts.h"

/// Writes a simulated street in the layouts of the data sets that there are importers of.
int main(int argc, char** argv) {
  using namespace lidar_upsampling;  // NOLINT(google-build-using-namespace)
  if (argc != 2) {
    std::cerr << "usage: small_data_sets FOLDER\n";
    return 2;
  }
  try {
    const std::filesystem::path folder = argv[1];
    const ArgoverseLog argoverse(folder / "argoverse");
    const DgpScene dgp(folder / "dgp");
    write_drive(folder / "kitti", SmallStreet());
    return 0;
  } catch (const std::exception& error) {
    std::cerr << error.what() << '\n';
    return 1;
  }
}
