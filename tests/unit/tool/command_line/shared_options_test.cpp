// SPDX-License-Identifier: MIT
#include "tool/command_line/shared_options.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "tests/temporary_folder.hpp"
#include "tool/command_line/failure.hpp"
#include "tool/replay/playback.hpp"

namespace cornerd::tool {
namespace {

TEST(ParsePose, ThreeNumbers_AreAPose) {
  const core::Pose2 pose = parse_pose("1.5,-2,3.5");
  EXPECT_DOUBLE_EQ(pose.x_m, 1.5);
  EXPECT_DOUBLE_EQ(pose.y_m, -2);
  EXPECT_DOUBLE_EQ(pose.theta_rad, 3.5 - core::kTwoPi);
}

TEST(ParsePose, OtherText_IsWrongUsage) {
  for (const char* text : {"", "1", "1,2", "1,2,", "1,2,3,4", "1,2,3 ", "a,b,c", "1,2,nan",
                           "1,inf,3", "1;2;3", ",,"}) {
    EXPECT_THROW(parse_pose(text), UsageError) << text;
  }
}

TEST(ParsePoints, PairsOfNumbers_ArePoints) {
  const auto points = parse_points(" 1,2  3,-4 ");
  ASSERT_EQ(points.size(), 2U);
  EXPECT_EQ(points[1], core::Vec2(3, -4));
  EXPECT_TRUE(parse_points("").empty());
  EXPECT_THROW(parse_points("1,2 3"), UsageError);
}

TEST(ParseClasses, UnknownName_IsWrongUsage) {
  const message::ClassSet classes = parse_classes({"POSE", "SCAN"});
  EXPECT_TRUE(classes.contains(message::MessageClass::kPose));
  EXPECT_TRUE(classes.contains(message::MessageClass::kScan));
  EXPECT_FALSE(classes.contains(message::MessageClass::kStatus));
  EXPECT_THROW(parse_classes({"POSE", "pose"}), UsageError);
}

TEST(ParseSpeed, MaxOrPositiveNumber_IsASpeed) {
  EXPECT_FALSE(parse_speed("max"));
  EXPECT_EQ(parse_speed("2.5"), 2.5);
  for (const char* text : {"", "0", "-1", "fast", "1x", "nan", "inf"}) {
    EXPECT_THROW(parse_speed(text), UsageError) << text;
  }
}

TEST(ParseWire, Names_GiveDriverAndFormat) {
  EXPECT_EQ(parse_wire("express").driver, drivers::DriverKind::kRplidar);
  EXPECT_EQ(parse_wire("express").format, rplidar::WireFormat::kExpress);
  EXPECT_EQ(parse_wire("ultra-dense").format, rplidar::WireFormat::kUltraDense);
  EXPECT_EQ(parse_wire("ld").driver, drivers::DriverKind::kLd);
  EXPECT_EQ(parse_wire("ydlidar").driver, drivers::DriverKind::kYdlidar);
  EXPECT_EQ(parse_wire("auto").driver, std::nullopt);
}

/// A process of a stand-in for /proc, with the words of its command line.
void add_process(const test::TemporaryFolder& folder, const std::string& pid,
                 const std::vector<std::string>& words) {
  std::filesystem::create_directory(folder / pid);
  std::filesystem::create_symlink(folder.path(), folder.path() / pid / "cwd");
  std::ofstream stream(folder.path() / pid / "cmdline");
  for (const std::string& word : words) stream << word << '\0';
}

TEST(RunningConfig, OnlyDaemon_GivesItsConfig) {
  const test::TemporaryFolder folder;
  std::ofstream(folder.path() / "a.json") << "{}";
  std::ofstream(folder.path() / "b.json") << "{}";
  EXPECT_EQ(running_config(folder.path()), "");
  add_process(folder, "1", {"/sbin/init", "--config", "b.json"});
  add_process(folder, "2", {"/usr/sbin/cornerd", "--config", "a.json"});
  add_process(folder, "3", {"cornerd", "--version"});
  EXPECT_EQ(running_config(folder.path()), folder.path() / "a.json");
  add_process(folder, "4", {"cornerd", "--config", "b.json"});
  EXPECT_EQ(running_config(folder.path()), "") << "two daemons";
}

}  // namespace
}  // namespace cornerd::tool
