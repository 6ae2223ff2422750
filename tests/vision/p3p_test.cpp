// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/vision/p3p.h"

#include <gtest/gtest.h>

#include <opencv2/calib3d.hpp>
#include <opencv2/core/eigen.hpp>
#include <random>

namespace lidar_upsampling {
namespace {

struct Problem {
  std::array<Eigen::Vector3d, 3> bearings;
  std::array<Eigen::Vector3d, 3> points;
  Pose truth = Pose::Identity();
};

/// Three points within `size` metres of an object `distance` metres away, in a frame of its own.
Problem make_problem(std::mt19937& generator, double distance, double size) {
  std::uniform_real_distribution<double> unit(-1, 1);
  const auto random = [&] {
    return Eigen::Vector3d(unit(generator), unit(generator), unit(generator));
  };
  Problem problem;
  problem.truth.linear() =
      Eigen::Quaterniond(unit(generator), unit(generator), unit(generator), unit(generator))
          .normalized()
          .toRotationMatrix();
  problem.truth.translation() = 10 * random();
  const Eigen::Vector3d centre(0.4 * distance * unit(generator), 0.2 * distance * unit(generator),
                               distance);
  for (std::size_t i = 0; i < 3; ++i) {
    const Eigen::Vector3d in_camera = centre + size * random();
    problem.bearings[i] = in_camera.normalized();
    problem.points[i] = problem.truth.inverse() * in_camera;
  }
  return problem;
}

double nearest_error(const std::vector<Pose>& poses, const Pose& truth) {
  double best = 1e9;
  for (const Pose& pose : poses) {
    best = std::min(best, (pose.matrix() - truth.matrix()).cwiseAbs().maxCoeff());
  }
  return best;
}

struct Distance {
  double distance;
  double size;
};

class P3pAt : public testing::TestWithParam<Distance> {};
INSTANTIATE_TEST_SUITE_P(Distances, P3pAt,
                         testing::Values(Distance{5, 2}, Distance{15, 2}, Distance{50, 1}));

TEST_P(P3pAt, one_of_the_poses_is_the_true_one) {
  std::mt19937 generator(11);
  int num_exact = 0;
  constexpr int kNumProblems = 2000;
  for (int i = 0; i < kNumProblems; ++i) {
    const Problem problem = make_problem(generator, GetParam().distance, GetParam().size);
    std::vector<Pose> poses;
    solve_p3p(problem.bearings, problem.points, &poses);
    ASSERT_LE(poses.size(), 4U);
    if (nearest_error(poses, problem.truth) < 1e-4) ++num_exact;
  }
  // Near a double root, or for points almost on a line, digits are lost for good.
  EXPECT_GT(num_exact, 0.985 * kNumProblems);
}

TEST_P(P3pAt, every_pose_sees_the_points_along_their_bearings) {
  std::mt19937 generator(12);
  for (int i = 0; i < 500; ++i) {
    const Problem problem = make_problem(generator, GetParam().distance, GetParam().size);
    std::vector<Pose> poses;
    solve_p3p(problem.bearings, problem.points, &poses);
    for (const Pose& pose : poses) {
      EXPECT_NEAR(pose.linear().determinant(), 1, 1e-9);
      for (std::size_t k = 0; k < 3; ++k) {
        EXPECT_LT(((pose * problem.points[k]).normalized() - problem.bearings[k]).norm(), 1e-5);
      }
    }
  }
}

TEST_P(P3pAt, recovers_the_truth_as_often_as_opencv) {
  std::mt19937 generator(13);
  int ours = 0;
  int opencvs = 0;
  for (int i = 0; i < 500; ++i) {
    const Problem problem = make_problem(generator, GetParam().distance, GetParam().size);
    std::vector<Pose> poses;
    solve_p3p(problem.bearings, problem.points, &poses);
    if (nearest_error(poses, problem.truth) < 1e-4) ++ours;
    std::vector<cv::Point3d> points;
    std::vector<cv::Point2d> pixels;
    for (std::size_t k = 0; k < 3; ++k) {
      points.emplace_back(problem.points[k].x(), problem.points[k].y(), problem.points[k].z());
      const Eigen::Vector2d pixel = problem.bearings[k].hnormalized();
      pixels.emplace_back(pixel.x(), pixel.y());
    }
    std::vector<cv::Mat> rotations;
    std::vector<cv::Mat> translations;
    cv::solveP3P(points, pixels, cv::Matx33d::eye(), cv::noArray(), rotations, translations,
                 cv::SOLVEPNP_AP3P);
    std::vector<Pose> opencv_poses;
    for (std::size_t k = 0; k < rotations.size(); ++k) {
      cv::Mat matrix;
      cv::Rodrigues(rotations[k], matrix);
      Pose pose = Pose::Identity();
      Eigen::Matrix3d rotation;
      Eigen::Vector3d translation;
      cv::cv2eigen(matrix, rotation);
      cv::cv2eigen(translations[k], translation);
      pose.linear() = rotation;
      pose.translation() = translation;
      opencv_poses.push_back(pose);
    }
    if (nearest_error(opencv_poses, problem.truth) < 1e-4) ++opencvs;
  }
  EXPECT_GE(ours, opencvs - 2);
}

TEST(P3p, points_on_a_line_or_together_have_no_pose) {
  const std::array<Eigen::Vector3d, 3> bearings{Eigen::Vector3d(0, 0, 1),
                                                Eigen::Vector3d(0.1, 0, 1).normalized(),
                                                Eigen::Vector3d(0.2, 0, 1).normalized()};
  std::vector<Pose> poses;
  solve_p3p(bearings,
            {Eigen::Vector3d(0, 0, 1), Eigen::Vector3d(1, 0, 1), Eigen::Vector3d(2, 0, 1)}, &poses);
  solve_p3p(bearings,
            {Eigen::Vector3d(1, 1, 1), Eigen::Vector3d(1, 1, 1), Eigen::Vector3d(1, 1, 1)}, &poses);
  EXPECT_TRUE(poses.empty());
}

}  // namespace
}  // namespace lidar_upsampling
