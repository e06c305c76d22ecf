// SPDX-License-Identifier: MIT
#include "core/map_filter.hpp"

#include <gtest/gtest.h>

#include <optional>
#include <vector>

namespace cornerd::core {
namespace {

constexpr std::optional<double> kLost;

/// A scan taken at `x_m` in each map that it fits.
void scan(MapFilter& filter, double x_m, const std::vector<std::optional<double>>& log_odds) {
  std::vector<MapEvidence> evidence(log_odds.size());
  for (std::size_t map = 0; map < log_odds.size(); ++map) {
    evidence[map].log_odds = log_odds[map];
    if (log_odds[map]) evidence[map].places[evidence[map].count++] = {x_m, 0, 0};
  }
  filter.update(evidence);
}

TEST(MapFilter, BeforeTheFirstScan_NoMap) {
  const MapFilter filter(3);
  EXPECT_TRUE(filter.in_doubt().empty());
  EXPECT_FALSE(filter.map());
  EXPECT_DOUBLE_EQ(filter.belief(2), 0.25);
}

TEST(MapFilter, OneMapFarAhead_NamedByTheSecondPlace) {
  MapFilter filter(3);
  scan(filter, 0, {5, 40, kLost});
  EXPECT_FALSE(filter.map()) << "a single scan names none";
  scan(filter, 1.5, {5, 40, kLost});
  EXPECT_EQ(filter.map(), 1U);
  EXPECT_GT(filter.belief(1), 1 - 1e-5);
}

/// Scans from one place see the same furniture.
TEST(MapFilter, RobotAtRest_CountsOnce) {
  MapFilter filter(2);
  for (int i = 0; i < 100; ++i) scan(filter, 0.005 * i, {40, kLost});
  EXPECT_EQ(filter.scans(), 1U);
  EXPECT_FALSE(filter.map());
}

TEST(MapFilter, BackAtAKnownPlace_CountsOnce) {
  MapFilter filter(2);
  for (int i = 0; i < 20; ++i) scan(filter, i % 2 == 0 ? 0 : 1.5, {20, 19});
  EXPECT_EQ(filter.scans(), 2U);
}

TEST(MapFilter, EqualMaps_BothInDoubtForEver) {
  MapFilter filter(3);
  for (int i = 0; i < 200; ++i) scan(filter, 1.5 * i, {30, 30, 4});
  EXPECT_EQ(filter.in_doubt().size(), 2U);
  EXPECT_TRUE(filter.is_ruled_out(2));
  EXPECT_FALSE(filter.map());
}

/// A scan among furniture that speaks for another floor by 22 nats, as one in 4,000 does.
TEST(MapFilter, OneMisleadingScan_NamesNoWrongMap) {
  MapFilter filter(2);
  scan(filter, 0, {kLost, 22});
  EXPECT_FALSE(filter.map());
  for (int i = 1; i <= 4; ++i) scan(filter, 1.5 * i, {40, 10});
  EXPECT_EQ(filter.map(), 0U);
}

TEST(MapFilter, ScansFitNoMap_None) {
  MapFilter filter(2);
  for (int i = 0; i < 9; ++i) scan(filter, 1.5 * i, {kLost, -4});
  EXPECT_TRUE(filter.in_doubt().empty());
}

TEST(MapFilter, Forget_EqualAgain) {
  MapFilter filter(2);
  for (int i = 0; i < 3; ++i) scan(filter, 1.5 * i, {40, kLost});
  filter.forget();
  EXPECT_FALSE(filter.map());
  scan(filter, 0, {kLost, 40});
  EXPECT_EQ(filter.in_doubt().front(), 1U);
}

}  // namespace
}  // namespace cornerd::core
