// SPDX-License-Identifier: MIT
#include "core/recognition/place_evidence.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace cornerd::core {
namespace {

/// A furnished room of which most walls are in sight.
BeamStatistics most_walls_hit() {
  BeamStatistics place;
  place.rays = 400;
  place.hits = 330;
  place.shorts = 70;
  place.map_sigma_m = 0.01;
  place.faces = 9;
  place.faces_log_ratio = 60;
  place.predicted = 400;
  place.predicted_hits = 320;
  place.obstacles_m = 0.8;
  return place;
}

constexpr ScanStructure kScan{.wall_m = 14, .segments = 14};
constexpr double kWallEnds = 2;

double log_odds(const BeamStatistics& place) { return log_odds_of_place(place, kWallEnds, kScan); }

TEST(PlaceEvidence, MostWallsHit_IsAFix) { EXPECT_GT(log_odds(most_walls_hit()), 11.5); }

TEST(PlaceEvidence, HalfOfTheFaces_LeavesADoubtOfAPercent) {
  BeamStatistics place = most_walls_hit();
  place.faces /= 2;
  place.faces_log_ratio /= 2;
  place.hits = 165;
  place.predicted_hits = 160;
  place.shorts = 235;
  place.obstacles_m = 5;
  EXPECT_LT(log_odds(place), std::log(99));
}

TEST(PlaceEvidence, RaysThroughWalls_SpeakAgainstThePlace) {
  BeamStatistics place = most_walls_hit();
  place.free_space_violations = 40;
  place.shorts -= 40;
  place.missing_walls = 2;
  place.rays_through = 40;
  EXPECT_LT(log_odds(place), log_odds(most_walls_hit()) - 6);
}

TEST(PlaceEvidence, WallsThatAreOff_AreLessEvidence) {
  BeamStatistics place = most_walls_hit();
  place.map_sigma_m = 0.05;
  EXPECT_LT(log_odds(place), log_odds(most_walls_hit()) - 2);
}

TEST(PlaceEvidence, WallEnds_AreEvidence) {
  EXPECT_GT(log_odds_of_place(most_walls_hit(), 4, kScan), log_odds(most_walls_hit()) + 1);
}

TEST(PlaceEvidence, FacesInViewThatNoRayHits_SpeakAgainstThePlace) {
  BeamStatistics place = most_walls_hit();
  place.unseen_faces = 4;
  EXPECT_LT(log_odds(place), log_odds(most_walls_hit()) - 3);
}

TEST(PlaceEvidence, RaysThatMissTheFaceTheyShouldMeet_SpeakAgainstThePlace) {
  BeamStatistics place = most_walls_hit();
  place.predicted_hits = 240;
  EXPECT_LT(log_odds(place), log_odds(most_walls_hit()) - 2);
}

TEST(PlaceEvidence, EightRays_AreNoFix) {
  const BeamStatistics place{.rays = 8,
                             .hits = 8,
                             .map_sigma_m = 0.003,
                             .faces_log_ratio = 25,
                             .faces = 2,
                             .predicted = 8,
                             .predicted_hits = 8};
  EXPECT_LT(log_odds_of_place(place, 0, {.wall_m = 0.3, .segments = 2}), 5);
}

TEST(PlaceEvidence, EmptyScan_IsFinite) {
  EXPECT_TRUE(std::isfinite(log_odds_of_place({.map_sigma_m = 0.003}, 0, {})));
}

TEST(ScanStructure, LongWalls_CountUpTo3m) {
  std::vector<WallSegment> segments(2);
  segments[0].last = {1, 0};
  segments[1].last = {0, 9};
  const ScanStructure scan = scan_structure(segments);
  EXPECT_DOUBLE_EQ(scan.wall_m, 4);
  EXPECT_DOUBLE_EQ(scan.segments, 2);
}

}  // namespace
}  // namespace cornerd::core
