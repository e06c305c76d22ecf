// SPDX-License-Identifier: MIT
#include "calibration/wall_model.hpp"

#include <gtest/gtest.h>

namespace cornerd::calibration {
namespace {

WallPiece piece(double from_m, double to_m, double constant_m) {
  WallPiece piece;
  piece.from_m = from_m;
  piece.to_m = to_m;
  piece.ray_rad = 1;
  piece.sigma_m = constant_m / 10;
  piece.coefficients[0][0] = constant_m;
  return piece;
}

TEST(WallModel, Empty_ErrsByNothing) {
  const WallModel model;
  EXPECT_EQ(model.error_m(1, 0.5), 0);
  EXPECT_EQ(model.sigma_m(1), 0);
  EXPECT_FALSE(model.covers(0.1));
}

TEST(WallModel, Coefficients_AreOfPowersOfRayAndDistance) {
  WallPiece only = piece(0, 2, 0.001);
  only.coefficients[0][1] = 0.002;
  only.coefficients[1][0] = 0.003;
  only.coefficients[2][3] = 0.004;
  only.coefficients[6][0] = 0.005;
  const double ray = -0.5;
  const double distance = 1.5;
  const double expected = 0.001 + 0.002 * distance + 0.003 * ray +
                          0.004 * ray * ray * distance * distance * distance +
                          0.005 * ray * ray * ray * ray * ray * ray;
  EXPECT_NEAR(WallModel({only}).error_m(distance, ray), expected, 1e-15);
}

TEST(WallModel, Distance_ChoosesThePiece) {
  const WallModel model({piece(0.15, 0.6, 0.01), piece(0.6, 1, 0.02)});
  EXPECT_EQ(model.error_m(0.6, 0), 0.01);
  EXPECT_EQ(model.error_m(0.7, 0), 0.02);
  EXPECT_EQ(model.sigma_m(0.3), 0.001);
  EXPECT_EQ(model.sigma_m(0.9), 0.002);
}

TEST(WallModel, BetweenPieces_TakesTheNearerOne) {
  const WallModel model({piece(0.2, 0.5, 0.01), piece(0.9, 1, 0.02)});
  EXPECT_EQ(model.error_m(0.6, 0), 0.01);
  EXPECT_EQ(model.error_m(0.8, 0), 0.02);
  EXPECT_EQ(model.error_m(0.1, 0), 0.01);
}

TEST(WallModel, BeyondWhatWasMeasured_HoldsTheNearest) {
  WallPiece only = piece(0.5, 1, 0);
  only.coefficients[1][1] = 1;
  const WallModel model({only});
  EXPECT_NEAR(model.error_m(0.1, 0.5), 0.25, 1e-12);
  EXPECT_NEAR(model.error_m(9, 0.5), 0.5, 1e-12);
  EXPECT_NEAR(model.error_m(1, 1.4), 1, 1e-12);
  EXPECT_NEAR(model.error_m(1, -1.4), -1, 1e-12);
  EXPECT_TRUE(model.covers(0.1));
  EXPECT_FALSE(model.covers(1.01));
}

}  // namespace
}  // namespace cornerd::calibration
