// SPDX-License-Identifier: MIT
#include "bench/odometry_experiment.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace cornerd::bench {
namespace {

using calibration::HeadingSource;

const ReckonedTrack& track_of(const OdometryResult& result, HeadingSource source, bool factors,
                              bool as_printed = true) {
  return *std::find_if(result.tracks.begin(), result.tracks.end(), [&](const ReckonedTrack& track) {
    return track.source == source && track.factors.has_value() == factors &&
           track.as_printed == as_printed;
  });
}

class OdometryExperiment : public ::testing::Test {
 protected:
  const OdometryResult result_ =
      run_odometry_case(odometry_robots().front(), *replay::find_scenario("circuit-1"), 1);
};

TEST_F(OdometryExperiment, AllModes_WithAndWithoutFactors) {
  ASSERT_EQ(result_.tracks.size(),
            13u);  // six as printed, six without the dead band, least squares
  EXPECT_NEAR(result_.length_m, 7.9, 0.1);
  for (const ReckonedTrack& track : result_.tracks) {
    EXPECT_GT(track.error.places, 100u);
    EXPECT_EQ(track.points.size(), track.error.places);
  }
}

TEST_F(OdometryExperiment, FittedFactors_ReduceTheError) {
  for (const HeadingSource mode : {HeadingSource::kEncoder, HeadingSource::kGyro}) {
    for (const bool as_printed : {true, false}) {
      EXPECT_LT(track_of(result_, mode, true, as_printed).error.mean_m,
                track_of(result_, mode, false, as_printed).error.mean_m);
    }
  }
}

TEST_F(OdometryExperiment, WeightedMean_BeatsMeanAndEncoder) {
  const double weighted_m = track_of(result_, HeadingSource::kWeighted, true).error.mean_m;
  EXPECT_LE(weighted_m, track_of(result_, HeadingSource::kEncoder, true).error.mean_m);
  EXPECT_LE(weighted_m, track_of(result_, HeadingSource::kMean, false).error.mean_m);
}

TEST_F(OdometryExperiment, DeadBand_HidesGyroBiasOnStraights) {
  // 0.01 rad/s is a tenth of the dead band in a step of 0.1 s.
  EXPECT_LT(track_of(result_, HeadingSource::kGyro, false, true).error.mean_m,
            0.7 * track_of(result_, HeadingSource::kGyro, false, false).error.mean_m);
}

TEST_F(OdometryExperiment, TrackPoints_EndErrorMatchesTheTable) {
  for (const ReckonedTrack& track : result_.tracks) {
    EXPECT_NEAR((track.points.back() - result_.truth.back()).norm(), track.error.end_m, 0.06);
  }
}

TEST_F(OdometryExperiment, SameSeed_SameResult) {
  const OdometryResult again =
      run_odometry_case(odometry_robots().front(), *replay::find_scenario("circuit-1"), 1);
  for (std::size_t i = 0; i < result_.tracks.size(); ++i) {
    EXPECT_EQ(again.tracks[i].error.mean_m, result_.tracks[i].error.mean_m);
  }
}

}  // namespace
}  // namespace cornerd::bench
