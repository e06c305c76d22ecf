// SPDX-License-Identifier: MIT
#include "mqtt/robot_state.hpp"

#include <gtest/gtest.h>

namespace cornerd::mqtt {
namespace {

message::ParsedPose pose_at(double t_s, double x_m, core::PoseState state = core::PoseState::kFix) {
  message::ParsedPose pose;
  pose.t_ns = core::from_seconds(t_s);
  pose.state = state;
  pose.T_map_base = core::Pose2{x_m, 0, 0};
  pose.covariance = core::Covariance3::Identity() * 1e-4;
  pose.age_s = 0;
  return pose;
}

RobotState robot_at(double t_s) {
  RobotState robot;
  robot.is_daemon_connected = true;
  robot.note(pose_at(t_s, 1), t_s);
  return robot;
}

TEST(RobotState, Deviation_Holds95Percent) {
  EXPECT_NEAR(*robot_at(1).deviation_m(), 0.01 * 2.4477, 1e-4);
}

TEST(RobotState, Localized_NeedsAFreshPoseWithinTheLimits) {
  RobotState robot = robot_at(10);
  EXPECT_TRUE(robot.is_localized(0.3, 3, 10));
  EXPECT_FALSE(robot.is_localized(0.3, 3, 12.5)) << "no pose for 2.5 s";
  EXPECT_FALSE(robot.is_localized(0.02, 3, 10)) << "less certain than the limit";
  robot.pose->age_s = 4;
  EXPECT_FALSE(robot.is_localized(0.3, 3, 10)) << "predicted for too long";
  robot.pose->age_s = 0;
  robot.is_daemon_connected = false;
  EXPECT_FALSE(robot.is_localized(0.3, 3, 10));
  EXPECT_EQ(robot.state_name(), "absent");
}

TEST(RobotState, LostPose_KeepsTheLastKnownOne) {
  RobotState robot = robot_at(1);
  message::ParsedPose lost;
  lost.t_ns = core::from_seconds(1.1);
  robot.note(lost, 1.1);
  EXPECT_FALSE(robot.is_localized(1, 1, 1.1));
  EXPECT_DOUBLE_EQ(robot.T_map_base->x_m, 1);
  EXPECT_EQ(robot.state_name(), "lost");
}

TEST(RobotState, Driving_IsMoreThanNoise) {
  RobotState robot = robot_at(1);
  robot.note(pose_at(1.1, 1.001), 1.1);
  EXPECT_FALSE(robot.is_driving);
  robot.note(pose_at(1.2, 1.021), 1.2);
  EXPECT_TRUE(robot.is_driving);
  robot.note(pose_at(-5, 2), 1.3);
  EXPECT_FALSE(robot.is_driving) << "the clock was set back";
}

TEST(RobotState, Action_RunsOnceAndTheOldestGo) {
  RobotState robot;
  EXPECT_TRUE(robot.add_action({"a", "t"}));
  EXPECT_FALSE(robot.add_action({"a", "t"}));
  robot.set_action("a", ActionStatus::kFailed, "why");
  EXPECT_EQ(robot.actions[0].result, "why");
  for (int i = 0; i < 100; ++i) robot.add_action({std::to_string(i), "t"});
  EXPECT_EQ(robot.actions.size(), kMaxActionStates);
  EXPECT_EQ(robot.actions.back().id, "99");
}

TEST(RobotState, MapId_IsTheSitesWhereItIsInUse) {
  RobotState robot = robot_at(1);
  robot.map_name = "own";
  EXPECT_EQ(robot.map_id(), "own");
  robot.maps = {{"hall", 3, false}, {"hall", 4, true}};
  EXPECT_EQ(robot.map_id(), "hall");
  EXPECT_EQ(robot.map_version(), 4u);
}

}  // namespace
}  // namespace cornerd::mqtt
