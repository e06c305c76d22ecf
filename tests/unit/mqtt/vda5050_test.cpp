// SPDX-License-Identifier: MIT
#include "mqtt/vda5050.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace cornerd::mqtt {
namespace {

using nlohmann::json;

const Vda5050::UnixTime kTime{std::chrono::milliseconds(1'492'256'403'120)};

BridgeConfig config_of(VdaVersion version) {
  BridgeConfig config;
  config.manufacturer = "acme";
  config.serial = "r-1";
  config.vda5050 = version;
  return config;
}

RobotState robot() {
  RobotState robot;
  robot.is_daemon_connected = true;
  message::ParsedPose pose;
  pose.state = core::PoseState::kTracking;
  pose.T_map_base = core::Pose2{1, 2, 0.5};
  pose.covariance = core::Covariance3::Identity() * 1e-4;
  robot.note(pose, 10);
  robot.map_name = "hall";
  return robot;
}

TEST(Vda5050, Time_IsIso8601InUtc) {
  EXPECT_EQ(iso_time(kTime), "2017-04-15T11:40:03.120Z");
  EXPECT_EQ(iso_time(Vda5050::UnixTime(std::chrono::milliseconds(-1))), "1969-12-31T23:59:59.999Z");
}

TEST(Vda5050, Topic_IsThatOfTheMajorVersion) {
  EXPECT_EQ(Vda5050(config_of(VdaVersion::kV20)).topic("state"), "uagv/v2/acme/r-1/state");
  EXPECT_EQ(Vda5050(config_of(VdaVersion::kV30)).topic("state"), "vda5050/v3/acme/r-1/state");
}

TEST(Vda5050, HeaderId_CountsEachTopic) {
  const BridgeConfig config = config_of(VdaVersion::kV20);
  Vda5050 writer(config);
  EXPECT_EQ(json::parse(writer.visualization(robot(), kTime, 10))["headerId"], 0);
  EXPECT_EQ(json::parse(writer.visualization(robot(), kTime, 10))["headerId"], 1);
  EXPECT_EQ(json::parse(writer.state(robot(), kTime, 10))["headerId"], 0);
}

TEST(Vda5050, State_SaysWhereTheRobotIs) {
  const BridgeConfig config = config_of(VdaVersion::kV21);
  const json state = json::parse(Vda5050(config).state(robot(), kTime, 10));
  EXPECT_EQ(state["version"], "2.1.0");
  EXPECT_EQ(state["agvPosition"]["positionInitialized"], true);
  EXPECT_EQ(state["agvPosition"]["mapId"], "hall");
  EXPECT_DOUBLE_EQ(state["agvPosition"]["x"], 1);
  EXPECT_NEAR(state["agvPosition"]["deviationRange"].get<double>(), 0.0245, 1e-4);
  EXPECT_TRUE(state["errors"].empty());
  EXPECT_TRUE(state["information"].is_array());
}

TEST(Vda5050, StateOfVersion3_HasItsNames) {
  const BridgeConfig config = config_of(VdaVersion::kV30);
  RobotState one = robot();
  one.add_action({"a", "initializePosition", ActionStatus::kFailed, "why"});
  const json state = json::parse(Vda5050(config).state(one, kTime, 10));
  EXPECT_EQ(state["mobileRobotPosition"]["localized"], true);
  EXPECT_EQ(state["instantActionStates"][0]["actionResult"], "why");
  EXPECT_EQ(state["errors"][0]["errorReferences"][0]["referenceValue"], "a");
  for (const char* key : {"powerSupply", "safetyState", "actionStates", "maps", "nodeStates"}) {
    EXPECT_TRUE(state.contains(key)) << key;
  }
  EXPECT_EQ(state["powerSupply"]["stateOfCharge"], 0);
  EXPECT_EQ(state["safetyState"]["activeEmergencyStop"], "NONE");
  EXPECT_EQ(json::parse(
                Vda5050(config).connection(Vda5050::Connection::kBroken, kTime))["connectionState"],
            "CONNECTION_BROKEN");
}

TEST(Vda5050, LostRobot_IsALocalizationError) {
  const BridgeConfig config = config_of(VdaVersion::kV20);
  RobotState one = robot();
  one.pose = message::ParsedPose{};
  one.hint = "the lidar is covered \xff";
  const json state = json::parse(Vda5050(config).state(one, kTime, 10));
  EXPECT_EQ(state["agvPosition"]["positionInitialized"], false);
  EXPECT_EQ(state["errors"][0]["errorType"], "LOCALIZATION_ERROR");
  EXPECT_NE(state["errors"][0]["errorDescription"].get<std::string>().find("covered"),
            std::string::npos);
}

TEST(Vda5050, Factsheet_HasTheNamesOfItsVersion) {
  const BridgeConfig v2 = config_of(VdaVersion::kV20);
  const json old = json::parse(Vda5050(v2).factsheet(kTime));
  EXPECT_EQ(old["protocolFeatures"]["agvActions"][0]["actionType"], "initPosition");
  EXPECT_EQ(old["typeSpecification"]["agvKinematic"], "DIFF");
  const BridgeConfig v3 = config_of(VdaVersion::kV30);
  const json now = json::parse(Vda5050(v3).factsheet(kTime));
  EXPECT_EQ(now["protocolFeatures"]["mobileRobotActions"][0]["actionType"], "initializePosition");
  EXPECT_EQ(now["typeSpecification"]["mobileRobotKinematics"], "DIFFERENTIAL");
  EXPECT_EQ(now["physicalParameters"]["maximumSpeed"], 0.5);
}

}  // namespace
}  // namespace cornerd::mqtt
