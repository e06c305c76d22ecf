// SPDX-License-Identifier: MIT
#include "core/estimate/scan_rotation.hpp"

#include <gtest/gtest.h>

#include "../fixtures.hpp"

namespace cornerd::core {
namespace {

constexpr TimeNs kPeriod_ns = 180'000'000;

class ScanRotationTest : public ::testing::TestWithParam<double> {
 protected:
  Scan at(const Pose2& T_map_lidar, int k) {
    Scan scan = source_.take(*map_, T_map_lidar);
    scan.shift(k * kPeriod_ns - scan.start_ns());
    return scan;
  }

  std::shared_ptr<const WallMap> map_ = testing::make_map(testing::l_shaped_room());
  testing::ScanSource source_{72};
  ScanRotation rotation_;
};

TEST_P(ScanRotationTest, TurnedLidar_RateIsTheTurnOverTheTime) {
  const double rate_rad_s = GetParam();
  rotation_.add(at({1.0, 0.9, 0.3}, 0));
  EXPECT_FALSE(rotation_.rate_rad_s());
  for (int k = 1; k < 5; ++k) {
    const double turned_rad = rate_rad_s * k * to_seconds(kPeriod_ns);
    rotation_.add(at({1.0 + 0.05 * k, 0.9, 0.3 + turned_rad}, k));
    const auto found = rotation_.rate_rad_s();
    ASSERT_TRUE(found);
    EXPECT_NEAR(*found, rate_rad_s, 0.2);
  }
}

INSTANTIATE_TEST_SUITE_P(Rates, ScanRotationTest, ::testing::Values(0, 0.5, -1.5, 3, -3.5));

TEST_F(ScanRotationTest, ScanAfterAPauseOrNothingInSight_RateIsUnknown) {
  rotation_.add(at({1, 1, 0}, 0));
  rotation_.add(at({1, 1, 0}, 20));
  EXPECT_FALSE(rotation_.rate_rad_s());
  rotation_.add(Scan());
  EXPECT_FALSE(rotation_.rate_rad_s());
  rotation_.add(at({1, 1, 0}, 21));
  EXPECT_FALSE(rotation_.rate_rad_s());
}

}  // namespace
}  // namespace cornerd::core
