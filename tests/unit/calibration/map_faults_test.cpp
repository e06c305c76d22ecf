// SPDX-License-Identifier: MIT
#include "calibration/map_faults.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <optional>
#include <string_view>
#include <vector>

namespace cornerd::calibration {
namespace {

using core::Vec2;

/// A room with an alcove, whose mirror image is another.
core::FloorPlan room(double scale = 1, double mirror = 1) {
  const std::vector<Vec2> outline = {{0, 0},   {4, 0}, {4, 1.5}, {5, 1.5},   {5, 2.3},
                                     {4, 2.3}, {4, 3}, {1.2, 3}, {1.2, 2.2}, {0, 2.2}};
  core::FloorPlan plan;
  plan.name = "room";
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Vec2 to(scale, scale * mirror);
    plan.walls.push_back({outline[i].cwiseProduct(to),
                          outline[(i + 1) % outline.size()].cwiseProduct(to), 0.02 * scale});
  }
  return plan;
}

/// Scans without noise at places in the room as it is.
std::vector<ScanSamples> scans() {
  const core::WallMap map(room());
  std::vector<ScanSamples> all;
  for (int k = 0; k < 12; ++k) {
    const core::Pose2 pose{0.6 + 0.25 * k, 0.8 + 0.09 * k, 0.5 * k};
    ScanSamples samples;
    for (int i = 0; i < 540; ++i) {
      core::Sample sample;
      sample.t_ns = i * core::TimeNs{250'000};
      const double bearing_rad = core::normalize_angle(-i * core::kTwoPi / 540);
      sample.bearing_rad = static_cast<float>(bearing_rad);
      sample.range_m =
          static_cast<float>(map.range_along(pose.translation(), pose.theta_rad + bearing_rad, 12));
      sample.quality = 47;
      sample.starts_scan = i == 0;
      sample.ends_scan = i == 539;
      samples.push_back(sample);
    }
    all.push_back(samples);
  }
  return all;
}

std::optional<MapFinding> found(const core::FloorPlan& plan,
                                const std::vector<core::FloorPlan>& others = {}) {
  return find_map_fault(plan, others, core::LocalizerConfig{}, scans(), [] { return false; });
}

std::string_view name(const core::FloorPlan& plan) {
  const auto finding = found(plan);
  return finding ? name_of(*finding) : "none";
}

TEST(MapFaults, RightMap_HasNone) { EXPECT_EQ(name(room()), "none"); }

TEST(MapFaults, MirroredMap_IsNamed) { EXPECT_EQ(name(room(1, -1)), "map-mirrored"); }

TEST(MapFaults, Millimetres_AreNamed) {
  const auto finding = found(room(1000));
  ASSERT_TRUE(finding);
  EXPECT_EQ(name_of(*finding), "map-units");
  EXPECT_EQ(finding->scale.x(), 0.001);
}

TEST(MapFaults, ScaledMap_GivesItsScale) {
  for (const double scale : {0.9, 1.05, 1.2}) {
    const auto finding = found(room(scale));
    ASSERT_TRUE(finding) << scale;
    ASSERT_EQ(name_of(*finding), "map-scale") << scale;
    EXPECT_NEAR(finding->scale.x() * scale, 1, 0.01);
    EXPECT_EQ(finding->scale.x(), finding->scale.y());
  }
}

TEST(MapFaults, StretchedMap_GivesTheAxis) {
  for (const double scale : {0.9, 1.07}) {
    const auto finding = found(room(1, scale));
    ASSERT_TRUE(finding) << scale;
    ASSERT_EQ(name_of(*finding), "map-scale") << scale;
    EXPECT_EQ(finding->scale.x(), 1);
    EXPECT_NEAR(finding->scale.y() * scale, 1, 0.01);
    EXPECT_THAT(describe(*finding, "a"), testing::HasSubstr("along y"));
  }
}

TEST(MapFaults, ScaleOfFewPercent_MayBeTheLidars) {
  EXPECT_THAT(describe({.fault = MapFault::kScale, .scale = {1.02, 1.02}}, "a"),
              testing::HasSubstr("calibrate bias"));
  EXPECT_THAT(describe({.fault = MapFault::kScale, .scale = {1.1, 1.1}}, "a"),
              testing::Not(testing::HasSubstr("calibrate bias")));
}

TEST(MapFaults, AnotherMapOfTheConfig_IsNamed) {
  core::FloorPlan hall;
  hall.walls = {
      {{0, 0}, {9, 0}, 0.1}, {{9, 0}, {9, 6}, 0.1}, {{9, 6}, {0, 7}, 0.1}, {{0, 7}, {0, 0}, 0.1}};
  core::FloorPlan home = room();
  home.name = "home";
  const auto finding = found(hall, {home});
  ASSERT_TRUE(finding);
  EXPECT_EQ(finding->map, "home");
  const auto nothing = found(hall);
  ASSERT_TRUE(nothing);
  EXPECT_EQ(name_of(*nothing), "map-mismatch");
}

}  // namespace
}  // namespace cornerd::calibration
