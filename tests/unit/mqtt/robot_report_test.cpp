// SPDX-License-Identifier: MIT
#include "mqtt/robot_report.hpp"

#include <gtest/gtest.h>

namespace cornerd::mqtt {
namespace {

TEST(RobotReport, WrittenReport_IsReadBack) {
  RobotReport report;
  report.manufacturer = "acme";
  report.serial = "r-1";
  report.t_ns = 1'795'161'601'000'000'000;
  report.state = "fix";
  report.is_localized = true;
  report.room = "hall \"1\"";
  report.T_map_base = core::Pose2{1.25, -2.5, 0.5};
  report.map = "m";
  report.map_version = 7;
  report.map_hash = "ab";
  report.problem = "none";
  const auto read = parse_robot_report(robot_report_json(report));
  ASSERT_TRUE(read);
  EXPECT_EQ(read->serial, "r-1");
  EXPECT_EQ(read->room, report.room);
  EXPECT_EQ(read->t_ns, report.t_ns);
  EXPECT_TRUE(read->is_localized);
  EXPECT_DOUBLE_EQ(read->T_map_base->y_m, -2.5);
  EXPECT_EQ(read->map_version, 7u);
  EXPECT_EQ(read->problem, "none");
}

TEST(RobotReport, Garbage_IsNone) {
  for (const char* text :
       {"", "[]", "{}", R"({"manufacturer":"a","serial":1,"t":0,"state":"fix"})",
        R"({"manufacturer":"a","serial":"b","t":1e99,"state":"fix"})",
        R"({"manufacturer":"a","serial":"b","t":0,"state":"fix","x":"1"})",
        R"({"manufacturer":"a","serial":"b","t":0,"state":"f","map_version":-1})"}) {
    EXPECT_FALSE(parse_robot_report(text)) << text;
  }
}

}  // namespace
}  // namespace cornerd::mqtt
