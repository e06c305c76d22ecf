// SPDX-License-Identifier: MIT
#include "bench/rate_experiment.hpp"

#include <gtest/gtest.h>

#include "settings/map_file.hpp"

namespace cornerd::bench {
namespace {

RateResult run_at(double rate_hz, bool gently = false) {
  return run_rate_case(settings::load_map(CORNERD_SOURCE_DIR "/config/maps/flat-7.json"), rate_hz,
                       gently, 1500, 1);
}

TEST(RateExperiment, TenReadingsASecond_BeatLidarAlone) {
  const RateResult alone = run_at(0);
  EXPECT_EQ(alone.predicted.scans(), 0u);
  for (const double rate_hz : {10.0, 20.0, 50.0}) {
    const RateResult with = run_at(rate_hz);
    EXPECT_EQ(with.scans, 1500u);
    EXPECT_EQ(with.fixes.wrong() + with.predicted.wrong(), 0u) << rate_hz;
    EXPECT_GT(with.fixes.scans(), alone.fixes.scans()) << rate_hz;
    EXPECT_LT(with.fixes.mean_error_m(), alone.fixes.mean_error_m()) << rate_hz;
    // The first start, before the delay of the readings is estimated.
    EXPECT_LT(with.worst_fix_m, alone.worst_fix_m + 0.001) << rate_hz;
  }
}

TEST(RateExperiment, ThreeReadingsASecond_NoWrongFix) {
  for (const bool gently : {false, true}) EXPECT_EQ(run_at(3, gently).fixes.wrong(), 0u) << gently;
}

TEST(RateExperiment, MoreReadings_SmallerErrors) {
  const RateResult few = run_at(10, true);
  const RateResult many = run_at(50, true);
  EXPECT_LT(many.fixes.mean_error_m(), few.fixes.mean_error_m());
  EXPECT_LT(many.worst_fix_rad, few.worst_fix_rad);
}

}  // namespace
}  // namespace cornerd::bench
