// SPDX-License-Identifier: MIT
#include "mqtt/fleet.hpp"

#include <gtest/gtest.h>

namespace cornerd::mqtt {
namespace {

const Fleet::UnixTime kNow{std::chrono::seconds(1'000'000)};

Message report_of(const std::string& serial, double t_s, bool is_retained = false) {
  return {"cornerd/hq/robot/acme/" + serial,
          R"({"manufacturer":"acme","serial":")" + serial + R"(","state":"fix","t":)" +
              std::to_string(t_s) + "}",
          is_retained};
}

TEST(Fleet, Age_IsSinceArrivalOrByTheReportsTime) {
  Fleet fleet("hq");
  fleet.take(report_of("live", 5), 100, kNow);
  fleet.take(report_of("old", 999'940, true), 100, kNow);
  fleet.take(report_of("ahead", 1'000'500, true), 100, kNow);
  const auto robots = fleet.robots(110);
  ASSERT_EQ(robots.size(), 3u);
  EXPECT_NEAR(robots[0].age_s, 10, 1e-6) << robots[0].report.serial;
  EXPECT_NEAR(robots[1].age_s, 10, 1e-6) << "its clock is wrong, not its report";
  EXPECT_NEAR(robots[2].age_s, 70, 1e-6);
}

TEST(Fleet, ForgedReport_IsIgnored) {
  Fleet fleet("hq");
  Message forged = report_of("a", 1);
  forged.topic = "cornerd/hq/robot/acme/b";
  fleet.take(forged, 1, kNow);
  forged.topic = "cornerd/other/robot/acme/a";
  fleet.take(forged, 1, kNow);
  fleet.take({"cornerd/hq/robot/acme/c", "garbage"}, 1, kNow);
  EXPECT_TRUE(fleet.robots(1).empty());
}

TEST(Fleet, RetainedReportThatIsTakenBack_IsGone) {
  Fleet fleet("hq");
  fleet.take(report_of("a", 1), 1, kNow);
  fleet.take({"cornerd/hq/robot/acme/a", ""}, 1, kNow);
  EXPECT_TRUE(fleet.robots(1).empty());
}

}  // namespace
}  // namespace cornerd::mqtt
