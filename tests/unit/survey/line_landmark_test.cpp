// SPDX-License-Identifier: MIT
#include "survey/line_landmark.hpp"

#include <gtest/gtest.h>

#include "mapped_scene.hpp"

namespace cornerd::survey {
namespace {

using core::Vec2;

TEST(LineLandmark, Construct_FromObservation_HasItsLineAndExtent) {
  const core::Pose2 T_map_lidar{1, 2, 0.7};
  const LineLandmark face(observation_of({3, 1}, {3, 4}, T_map_lidar), T_map_lidar, 0);
  EXPECT_NEAR((face.first() - Vec2(3, 1)).norm(), 0, 1e-9);
  EXPECT_NEAR((face.last() - Vec2(3, 4)).norm(), 0, 1e-9);
  EXPECT_NEAR(face.height_of({2, 0}), 1, 1e-9) << "the free space is on the left of the trajectory";
}

TEST(LineLandmark, Update_WithOtherEnd_RotatesAndExtends) {
  const core::Pose2 here;
  LineLandmark face(observation_of({3, 1}, {3, 2}, here), here, 0);
  for (int i = 0; i < 200; ++i) face.update(observation_of({3.02, 2}, {3.04, 4}, here), here, 1);
  EXPECT_NEAR(face.height_of({3.03, 3}), 0, 0.002);
  EXPECT_NEAR(face.end_m() - face.begin_m(), 3, 0.01);
  EXPECT_EQ(face.observations, 201U);
}

TEST(LineLandmark, Update_RepeatedNTimes_DividesVarianceByN) {
  const core::Pose2 here;
  LineLandmark face(observation_of({3, 1}, {3, 2}, here), here, 0);
  const double first_m2 = face.variance_at(0);
  for (int i = 0; i < 24; ++i) face.update(observation_of({3, 1}, {3, 2}, here), here, 1);
  EXPECT_NEAR(face.variance_at(0), first_m2 / 25, first_m2 * 1e-6);
}

TEST(LineLandmark, VarianceAt_FarAlong_GrowsWithAngleVariance) {
  const LineLandmark face = face_between({3, 1}, {3, 2});
  EXPECT_NEAR(face.variance_at(10), face.variance_at(0) + 100 * face.covariance()(0, 0), 1e-9);
}

}  // namespace
}  // namespace cornerd::survey
