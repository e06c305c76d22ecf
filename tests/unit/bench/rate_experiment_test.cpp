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

/// Where the speed jumps in the middle of a scan, 0.25 m/s for half of its 0.18 s are in its pose.
constexpr double kJumpInAScan_m = 0.25 * 0.18 / 2;
/// Walls that the scans so far do not show to be where the map has them take a part of a motion.
constexpr double kOffsets_m = 0.01;
/// Three times the error of a pose at rest.
constexpr double kNoise_m = 3 * 0.0005;

TEST(RateExperiment, TenReadingsASecond_BeatLidarAlone) {
  for (const bool gently : {false, true}) {
    const RateResult alone = run_at(0, gently);
    EXPECT_EQ(alone.predicted.scans(), 0u);
    for (const double rate_hz : {10.0, 20.0, 50.0}) {
      const RateResult with = run_at(rate_hz, gently);
      EXPECT_EQ(with.scans, 1500u);
      EXPECT_EQ(with.fixes.wrong() + with.predicted.wrong(), 0u) << rate_hz;
      // Scans in which the speed jumps are not named always.
      EXPECT_GT(with.fixes.scans(), 0.99 * static_cast<double>(with.scans)) << rate_hz << gently;
      EXPECT_LT(with.worst_fix_m, kJumpInAScan_m + kOffsets_m + kNoise_m) << rate_hz;
      if (gently) {
        EXPECT_LT(with.fixes.mean_error_m(), alone.fixes.mean_error_m()) << rate_hz;
      }
    }
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
