// SPDX-License-Identifier: MIT
#include "survey/line_extractor.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "replay/simulator/scan_simulator.hpp"

namespace cornerd::survey {
namespace {

/// A room of 4 x 3 m, seen from its middle.
std::vector<LineObservation> look(const core::Pose2& T_map_lidar, std::uint64_t seed) {
  const core::WallMap map(
      {"room",
       0,
       {{{0, 0}, {4, 0}, 0}, {{4, 0}, {4, 3}, 0}, {{4, 3}, {0, 3}, 0}, {{0, 3}, {0, 0}, 0}},
       {}});
  replay::ScanSimulator simulator({}, 540, seed);
  core::PolarScan points;
  points.assign(simulator.take(map, T_map_lidar), 0.15, 12);
  LineExtractor extractor({}, {});
  std::vector<LineObservation> observations;
  extractor.extract(points, observations);
  return observations;
}

TEST(LineExtractor, Extract_Room_GivesFourLines) {
  const auto observations = look({2, 1.5, 0.3}, 1);
  ASSERT_EQ(observations.size(), 4U);
  for (const LineObservation& seen : observations) {
    const core::Vec2 normal = core::unit_vector(seen.normal_rad);
    EXPECT_LT(normal.dot(seen.centroid), 0) << "the normal points to the lidar";
    const double height_m = -normal.dot(seen.centroid);
    EXPECT_TRUE(std::abs(height_m - 2) < 0.01 || std::abs(height_m - 1.5) < 0.01) << height_m;
    EXPECT_GT(seen.length_m(), 2.7);
  }
}

TEST(LineExtractor, Extract_ManyScans_ErrorsMatchSigmas) {
  double chi2 = 0;
  int count = 0;
  for (std::uint64_t seed = 1; seed <= 100; ++seed) {
    for (const LineObservation& seen : look({2, 1.5, 0}, seed)) {
      const core::Vec2 normal = core::unit_vector(seen.normal_rad);
      const double height_m = -normal.dot(seen.centroid);
      const double truth_m = std::abs(normal.x()) > 0.5 ? 2 : 1.5;
      chi2 += std::pow((height_m - truth_m) / seen.sigma_offset_m, 2);
      ++count;
    }
  }
  // One degree of freedom each; the sigma floor of 1 mm makes it conservative.
  EXPECT_GT(chi2 / count, 0.02);
  EXPECT_LT(chi2 / count, 1.3);
}

}  // namespace
}  // namespace cornerd::survey
