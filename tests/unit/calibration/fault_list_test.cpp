// SPDX-License-Identifier: MIT
#include "calibration/fault_list.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace cornerd::calibration {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

core::WallMap flat() {
  core::FloorPlan plan;
  plan.name = "flat";
  plan.walls = {{{0, 0}, {4, 0}, 0.1}, {{4, 0}, {4, 3}, 0.1}};
  return core::WallMap(plan);
}

/// The last hundred scans: `lost` of them, the others at `x_m`.
RecentPoses recent(std::size_t lost, const core::WallMap& map, double x_m = 1,
                   core::PoseState as = core::PoseState::kLost, std::size_t segments = 4,
                   const RecentPoses::Limits& limits = {}) {
  RecentPoses poses;
  core::Scan scan;
  for (int i = 0; i < 10; ++i) scan.add({.bearing_rad = 0.1F * i, .range_m = 0.5F * i});
  for (std::size_t i = 0; i < 150; ++i) {
    core::ScanResult result;
    result.detection.segments.resize(segments);
    result.pose.state = i < 50 || i >= 50 + lost ? core::PoseState::kFix : as;
    result.pose.T_map_base.x_m = x_m;
    poses.add(result, scan, limits, &map);
  }
  return poses;
}

TEST(RecentPoses, ScansOfAnUncoveredLidarThatOdometryCarriesOn_FitNowhere) {
  const core::WallMap map = flat();
  EXPECT_EQ(recent(30, map, 1, core::PoseState::kPredicted).lost(), 30U);
  EXPECT_EQ(recent(30, map, 1, core::PoseState::kPredicted, /*segments=*/1).lost(), 0U);
  EXPECT_EQ(recent(30, map, 1, core::PoseState::kLost, /*segments=*/0).lost(), 0U);
}

TEST(FaultList, MostlyLost_IsMismatchUntilAVariantFits) {
  const core::WallMap map = flat();
  FaultList few;
  few.add_map({}, recent(94, map), &map.plan());
  EXPECT_THAT(few.names(), IsEmpty());
  FaultList many;
  many.add_map({}, recent(95, map), &map.plan());
  EXPECT_THAT(many.names(), ElementsAre("map-mismatch"));
  EXPECT_THAT(many.hint(), HasSubstr("95 of the last 100 scans fit nowhere in the map \"flat\""));
  FaultList found;
  found.add_map(MapFinding{.fault = MapFault::kMirrored}, recent(20, map), &map.plan());
  EXPECT_THAT(found.names(), ElementsAre("map-mirrored"));
}

TEST(FaultList, ExaminedInVain_MismatchWhereThreeQuartersHaveNoPose) {
  const core::WallMap map = flat();
  const MapFinding in_vain{.fault = MapFault::kNoVariant};
  FaultList few;
  few.add_map(in_vain, recent(74, map), &map.plan());
  EXPECT_THAT(few.names(), IsEmpty());
  FaultList many;
  many.add_map(in_vain, recent(75, map), &map.plan());
  EXPECT_THAT(many.names(), ElementsAre("map-mismatch"));
  FaultList alike;
  alike.add_map(in_vain, recent(99, map, 1, core::PoseState::kAmbiguous), &map.plan());
  EXPECT_THAT(alike.names(), IsEmpty());
}

TEST(FaultList, NoScanWithAPose_IsNamedWhateverTheCause) {
  const core::WallMap map = flat();
  FaultList alike;
  alike.add_map({}, recent(100, map, 1, core::PoseState::kAmbiguous), &map.plan());
  EXPECT_THAT(alike.names(), ElementsAre("map-alike"));
  EXPECT_THAT(alike.hint(), HasSubstr("cornerctl set-pose"));
  FaultList blank;
  blank.add_map({}, recent(100, map, 1, core::PoseState::kLost, /*segments=*/2), &map.plan());
  EXPECT_THAT(blank.names(), ElementsAre("no-walls"));
}

TEST(FaultList, TwoThirdsOfAMinuteLost_IsNamed) {
  const core::WallMap map = flat();
  RecentPoses poses;
  core::ScanResult result;
  result.detection.segments.resize(4);
  const auto drive = [&](std::size_t lost_of_ten) {
    for (std::size_t i = 0; i < RecentPoses::kScansOfAMinute; ++i) {
      result.pose.state = i % 10 < lost_of_ten ? core::PoseState::kLost : core::PoseState::kFix;
      poses.add(result, {}, {}, &map);
    }
    FaultList faults;
    faults.add_map({}, poses, &map.plan());
    return std::vector<std::string_view>(faults.names().begin(), faults.names().end());
  };
  EXPECT_THAT(drive(6), IsEmpty());
  EXPECT_THAT(drive(7), ElementsAre("map-mismatch"));
}

TEST(FaultList, ReturnsBeyondTheLimits_AreNamed) {
  const core::WallMap map = flat();
  const auto names = [&](double min_m, double max_m, std::size_t lost = 10) {
    FaultList faults;
    faults.add_map({}, recent(lost, map, 1, core::PoseState::kLost, 4, {min_m, max_m}),
                   &map.plan());
    return std::vector<std::string_view>(faults.names().begin(), faults.names().end());
  };
  EXPECT_THAT(names(0.15, 12), IsEmpty());
  EXPECT_THAT(names(2.1, 12), IsEmpty()) << "the robot's own body may be in half of the view";
  EXPECT_THAT(names(0.15, 2), ElementsAre("range-limits"));
  EXPECT_THAT(names(0.15, 2, /*lost=*/7), IsEmpty());
  EXPECT_THAT(names(4, 12), ElementsAre("range-limits"));
}

TEST(FaultList, PosesOutsideOfTheMap_AreNamed) {
  const core::WallMap map = flat();
  FaultList near;
  near.add_map({}, recent(0, map, 4.9), &map.plan());
  EXPECT_THAT(near.names(), IsEmpty());
  FaultList far;
  far.add_map({}, recent(5, map, -9), &map.plan());
  EXPECT_THAT(far.names(), ElementsAre("outside-map"));
  EXPECT_THAT(far.hint(), HasSubstr("lidar.mount"));
}

TEST(FaultList, CountsThatBeginAgain_MayWrap) {
  DriveFaults drive;
  drive.drive.push_back({.fault = DriveFault::kLeftUnrelated});
  core::OdometrySummary odometry;
  FaultList never;
  never.add_drive(drive, {}, {}, odometry);
  EXPECT_THAT(never.hint(), Not(HasSubstr("counter_max")));
  odometry.counters.restarts = 1;
  FaultList once;
  once.add_drive(drive, {}, {}, odometry);
  EXPECT_THAT(once.hint(), HasSubstr("1 times so far: if they wrap"));
  odometry.counters.restarts = 5;
  FaultList often;
  often.add_drive(drive, {}, {}, odometry);
  EXPECT_THAT(often.hint(),
              HasSubstr("5 times so far: if they wrap, set advanced.odometry.counter_max"));
}

TEST(FaultList, MaxSpeedThatIsTooLow_IsInTheHint) {
  core::ScanResult result;
  result.odometry.present = true;
  result.odometry.counters.readings = 1000;
  RecentPoses poses;
  const core::WallMap map = flat();
  for (std::size_t i = 0; i < RecentPoses::kScans; ++i) poses.add(result, {}, {}, &map);
  const auto hint = [&](std::uint64_t jumps) {
    result.odometry.counters.jumps = jumps;
    FaultList faults;
    faults.add_drive({}, {}, poses, result.odometry);
    return faults.hint();
  };
  EXPECT_THAT(hint(10), Not(HasSubstr("max_speed")));
  EXPECT_THAT(hint(100), HasSubstr("100 readings moved farther than advanced.odometry.max_speed"));
}

TEST(FaultList, HintIsAboutTheFirst) {
  FaultList faults;
  faults.add("no-port", "plug it in");
  core::ScanResult result;
  result.odometry.present = true;
  RecentPoses poses;
  const core::WallMap map = flat();
  for (int i = 0; i < 50; ++i) {
    FaultList early;
    early.add_drive({}, {}, poses, result.odometry);
    EXPECT_THAT(early.names(), IsEmpty()) << "a slip contradicts, too";
    poses.add(result, {}, {}, &map);
  }
  faults.add_drive({}, {}, poses, result.odometry);
  EXPECT_THAT(faults.names(), ElementsAre("no-port", "odometry-unhealthy"));
  EXPECT_EQ(faults.hint(), "plug it in");
}

}  // namespace
}  // namespace cornerd::calibration
