// SPDX-License-Identifier: MIT
#include "calibration/wall_model.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

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

TEST(WallModel, Empty_HasZeroError) {
  const WallModel model;
  EXPECT_EQ(model.error_m(1, 0.5), 0);
  EXPECT_EQ(model.sigma_m(1), 0);
  EXPECT_FALSE(model.covers(0.1));
}

TEST(WallModel, Coefficients_MultiplyPowersOfRayAndDistance) {
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

TEST(WallModel, Distance_SelectsPiece) {
  const WallModel model({piece(0.15, 0.6, 0.01), piece(0.6, 1, 0.02)});
  EXPECT_EQ(model.error_m(0.6, 0), 0.01);
  EXPECT_EQ(model.error_m(0.7, 0), 0.02);
  EXPECT_EQ(model.sigma_m(0.3), 0.001);
  EXPECT_EQ(model.sigma_m(0.9), 0.002);
}

TEST(WallModel, BetweenPieces_UsesNearerPiece) {
  const WallModel model({piece(0.2, 0.5, 0.01), piece(0.9, 1, 0.02)});
  EXPECT_EQ(model.error_m(0.6, 0), 0.01);
  EXPECT_EQ(model.error_m(0.8, 0), 0.02);
  EXPECT_EQ(model.error_m(0.1, 0), 0.01);
}

TEST(WallModel, OutsideMeasuredRange_IsClamped) {
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

/// The paper's measurement: walls at 0.15 to 2.25 m every 5 cm, 5 scans of each.
std::vector<WallReturn> measure(auto error_m, double sigma_m, double step_m = 0.05) {
  std::mt19937 engine(3);
  std::normal_distribution<double> normal;
  std::vector<WallReturn> returns;
  for (double distance_m = 0.15; distance_m < 2.26; distance_m += step_m) {
    for (int i = 0; i < 5 * 120; ++i) {
      const double ray_rad = -1.2 + 2.4 * (i % 120) / 119;
      returns.push_back(
          {distance_m, ray_rad, error_m(distance_m, ray_rad) + sigma_m * normal(engine)});
    }
  }
  return returns;
}

WallModel model_of(const std::vector<WallPieceFit>& fits) {
  std::vector<WallPiece> pieces;
  for (const WallPieceFit& fit : fits) pieces.push_back(fit.piece);
  return WallModel(pieces);
}

TEST(FitWallModel, PolynomialsOfPapersOrders_AreFound) {
  const auto error_m = [](double d, double ray) {
    const double of_any = 0.002 - 0.003 * ray;
    if (d <= 0.6)
      return of_any + 0.01 * std::pow(ray, 6) * (0.6 - d) + 0.004 * ray * ray * d * d * d;
    if (d <= 1) return of_any + 0.004 * ray * ray * d * d * d;
    return of_any + 0.004 * ray * ray * d;
  };
  const auto fits = fit_wall_model(measure(error_m, 0.0015));
  ASSERT_EQ(fits.size(), 3u);
  const WallModel model = model_of(fits);
  for (const double d : {0.2, 0.33, 0.5, 0.7, 0.95, 1.2, 1.7, 2.2}) {
    for (const double ray : {-1.1, -0.5, 0.0, 0.4, 1.0}) {
      EXPECT_NEAR(model.error_m(d, ray), error_m(d, ray), 0.0003) << d << ' ' << ray;
    }
    EXPECT_NEAR(model.sigma_m(d), 0.0015, 0.0002);
  }
  for (const WallPieceFit& fit : fits) EXPECT_NEAR(fit.beyond_3_sigma, 0.0027, 0.004);
  EXPECT_EQ(fits[0].ray_order, 6u);
  EXPECT_EQ(fits[0].distance_order, 3u);
  EXPECT_EQ(fits[0].distances, 10u);
  EXPECT_EQ(fits[1].ray_order, 2u);
  EXPECT_EQ(fits[1].distance_order, 3u);
  EXPECT_EQ(fits[2].ray_order, 2u);
  EXPECT_EQ(fits[2].distance_order, 1u);
}

TEST(FitWallModel, Outliers_AreLeftOut) {
  auto returns = measure([](double, double) { return 0.003; }, 0.001);
  for (std::size_t i = 0; i < returns.size(); i += 20) returns[i].error_m += 0.05;
  for (const WallPieceFit& fit : fit_wall_model(returns)) {
    EXPECT_NEAR(fit.piece.sigma_m, 0.001, 0.0001);
    EXPECT_NEAR(model_of({fit}).error_m(fit.piece.to_m, 0), 0.003, 0.0003);
    EXPECT_NEAR(fit.beyond_3_sigma, 0.05, 0.01);
  }
}

TEST(FitWallModel, FewDistances_LowerTheOrder) {
  // Walls at 0.15, 0.85 and 1.55, 2.25 m.
  const auto error_m = [](double d, double ray) { return 0.002 * ray + 0.001 * d; };
  const auto fits = fit_wall_model(measure(error_m, 0.0005, 0.7));
  ASSERT_EQ(fits.size(), 3u);
  EXPECT_EQ(fits[0].distance_order, 0u);
  EXPECT_EQ(fits[1].distance_order, 0u);
  EXPECT_EQ(fits[2].distance_order, 1u);
  EXPECT_NEAR(model_of(fits).error_m(0.15, 1), 0.00215, 0.0002);
  EXPECT_NEAR(model_of(fits).error_m(0.9, -1), -0.00115, 0.0002);
  EXPECT_NEAR(model_of(fits).error_m(2.0, 1), 0.004, 0.0002);
}

TEST(FitWallModel, WallAtBorder_GivesOnePiece) {
  std::vector<WallReturn> border;
  for (int i = 0; i < 500; ++i) border.push_back({0.6, -1 + 0.004 * i, 0.001});
  EXPECT_EQ(fit_wall_model(border).size(), 1u);
}

TEST(FitWallModel, DistancesWithoutReturns_HaveNoPiece) {
  EXPECT_TRUE(fit_wall_model({}).empty());
  std::vector<WallReturn> near;
  for (const WallReturn& each : measure([](double, double) { return 0.0; }, 0.001)) {
    if (each.distance_m < 0.5) near.push_back(each);
  }
  const auto fits = fit_wall_model(near);
  ASSERT_EQ(fits.size(), 1u);
  EXPECT_NEAR(fits[0].piece.from_m, 0.15, 1e-9);
  EXPECT_LT(fits[0].piece.to_m, 0.5);
}

}  // namespace
}  // namespace cornerd::calibration
