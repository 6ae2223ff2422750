// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "kitti2rawlog/kitti_calibration.h"

#include <sstream>
#include <stdexcept>

#include "import/input_file.h"

namespace lidar_upsampling::kitti {
namespace {

// A calibration file and its name, for what is wrong with it.
class Entries {
 public:
  explicit Entries(const std::string& path) : path_(path), file_(read_calibration_file(path)) {}

  [[nodiscard]] bool has(const std::string& name) const { return file_.count(name) > 0; }

  [[nodiscard]] const double* numbers(const std::string& name, std::size_t count) const {
    const auto it = file_.find(name);
    if (it == file_.end() || it->second.size() != count) {
      throw std::runtime_error(path_ + ": no entry '" + name + "' of " + std::to_string(count) +
                               " numbers");
    }
    return it->second.data();
  }

  template <int Rows, int Columns>
  [[nodiscard]] Eigen::Matrix<double, Rows, Columns> matrix(const std::string& name) const {
    constexpr int kOrder = Columns == 1 ? Eigen::ColMajor : Eigen::RowMajor;
    using Stored = Eigen::Matrix<double, Rows, Columns, kOrder>;
    return Eigen::Map<const Stored>(numbers(name, static_cast<std::size_t>(Rows * Columns)));
  }

  // The files hold seven digits, so rotations are not quite orthogonal.
  [[nodiscard]] Eigen::Matrix3d nearest_rotation(const std::string& name,
                                                 const Eigen::Matrix3d& R) const {
    constexpr double kTolerance = 0.01;
    if (!(R.transpose() * R).isIdentity(kTolerance) || !(R.determinant() > 0))
      fail(name, "is no rotation");
    return Eigen::Quaterniond(R).normalized().toRotationMatrix();
  }

  [[noreturn]] void fail(const std::string& name, const std::string& what) const {
    throw std::runtime_error(path_ + ": entry '" + name + "' " + what);
  }

 private:
  std::string path_;
  CalibrationFile file_;
};

Pose rigid_motion(const std::string& path) {
  const Entries entries(path);
  Pose T = Pose::Identity();
  T.linear() = entries.nearest_rotation("R", entries.matrix<3, 3>("R"));
  T.translation() = entries.matrix<3, 1>("T");
  return T;
}

// A rectified camera: K and the offset from camera 0 are both in its projection matrix.
Camera camera_from(const Entries& entries, const std::string& name, int number,
                   const Pose& T_rectified_0_vehicle) {
  const auto P = entries.matrix<3, 4>(name);
  Camera camera;
  camera.label = "CAM" + std::to_string(number);
  camera.model.fx = P(0, 0);
  camera.model.fy = P(1, 1);
  camera.model.cx = P(0, 2);
  camera.model.cy = P(1, 2);
  Pose T_camera_rectified_0 = Pose::Identity();
  T_camera_rectified_0.translation() = P.leftCols<3>().inverse() * P.col(3);
  camera.T_vehicle_camera = (T_camera_rectified_0 * T_rectified_0_vehicle).inverse();
  if (!(camera.model.fx > 0 && camera.model.fy > 0 && camera.T_vehicle_camera.matrix().allFinite()))
    entries.fail(name, "is no camera's projection");
  return camera;
}

Camera camera_of_drive(const Entries& entries, int number, const Pose& T_rectified_0_vehicle) {
  const std::string suffix = "_rect_0" + std::to_string(number);
  Camera camera = camera_from(entries, "P" + suffix, number, T_rectified_0_vehicle);
  const auto size = entries.matrix<2, 1>("S" + suffix);
  camera.model.width = static_cast<int>(size.x());
  camera.model.height = static_cast<int>(size.y());
  return camera;
}

}  // namespace

CalibrationFile read_calibration_file(const std::string& path) {
  std::ifstream in = importing::open_file(path);
  if (!in) throw std::runtime_error("cannot read the calibration " + path);
  CalibrationFile file;
  for (std::string line; std::getline(in, line);) {
    const auto colon = line.find(':');
    if (colon == std::string::npos) continue;
    std::istringstream values(line.substr(colon + 1));
    std::vector<double> numbers;
    for (double value = 0; values >> value;) numbers.push_back(value);
    values >> std::ws;
    if (!numbers.empty() && values.eof()) file[line.substr(0, colon)] = numbers;
  }
  return file;
}

Calibration read_calibration(const std::string& folder) {
  const Pose T_lidar_vehicle = rigid_motion(folder + "/calib_imu_to_velo.txt");
  const Pose T_camera_0_lidar = rigid_motion(folder + "/calib_velo_to_cam.txt");
  const Entries cameras(folder + "/calib_cam_to_cam.txt");
  Pose T_rectified_0_camera_0 = Pose::Identity();
  T_rectified_0_camera_0.linear() =
      cameras.nearest_rotation("R_rect_00", cameras.matrix<3, 3>("R_rect_00"));
  const Pose T_rectified_0_vehicle = T_rectified_0_camera_0 * T_camera_0_lidar * T_lidar_vehicle;
  Calibration calibration;
  calibration.T_vehicle_lidar = T_lidar_vehicle.inverse();
  calibration.T_vehicle_rectified_0 = T_rectified_0_vehicle.inverse();
  for (int number = 0; number < 4; ++number) {
    if (!cameras.has("P_rect_0" + std::to_string(number))) continue;
    calibration.cameras[number] = camera_of_drive(cameras, number, T_rectified_0_vehicle);
  }
  return calibration;
}

Calibration read_sequence_calibration(const std::string& path) {
  const Entries entries(path);
  const auto Tr = entries.matrix<3, 4>("Tr");
  Pose T_camera_0_vehicle = Pose::Identity();
  T_camera_0_vehicle.linear() = entries.nearest_rotation("Tr", Tr.leftCols<3>());
  T_camera_0_vehicle.translation() = Tr.col(3);
  Calibration calibration;
  calibration.T_vehicle_rectified_0 = T_camera_0_vehicle.inverse();
  for (int number = 0; number < 4; ++number) {
    const std::string name = "P" + std::to_string(number);
    if (!entries.has(name)) continue;
    calibration.cameras[number] = camera_from(entries, name, number, T_camera_0_vehicle);
  }
  return calibration;
}

}  // namespace lidar_upsampling::kitti
