// SPDX-License-Identifier: MIT
#include "foxglove/converter.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

namespace cornerd::foxglove {
namespace {

using nlohmann::json;

class ConverterTest : public ::testing::Test {
 protected:
  void convert(const std::string& line) {
    converter_.convert(line, 7,
                       [this](ChannelId channel, core::TimeNs t_ns, std::string_view text) {
                         messages_[channel].push_back(json::parse(text));
                         times_[channel] = t_ns;
                       });
  }
  Converter converter_;
  std::map<ChannelId, std::vector<json>> messages_;
  std::map<ChannelId, core::TimeNs> times_;
};

TEST_F(ConverterTest, Pose_IsPoseAndTransforms) {
  convert(
      R"({"class":"STATUS","t":1,"lidar":{"state":"running","mount":{"x":0.1,"y":0,"theta":3.1}}})");
  convert(R"({"class":"POSE","seq":1,"t":1.5,"state":"fix","x":2,"y":3,"theta":1})");
  const json pose = messages_[ChannelId::kPose].at(0);
  EXPECT_EQ(pose["frame_id"], "map");
  EXPECT_EQ(pose["timestamp"], json::parse(R"({"sec":1,"nsec":500000000})"));
  EXPECT_EQ(pose["pose"]["position"], json::parse(R"({"x":2,"y":3,"z":0})"));
  EXPECT_NEAR(pose["pose"]["orientation"]["z"], std::sin(0.5), 1e-6);
  const auto& transforms = messages_[ChannelId::kTransform];
  ASSERT_EQ(transforms.size(), 2u);
  EXPECT_EQ(transforms[0]["child_frame_id"], "lidar");
  EXPECT_EQ(transforms[0]["translation"]["x"], 0.1);
  EXPECT_EQ(transforms[1]["parent_frame_id"], "map");
  EXPECT_EQ(messages_[ChannelId::kPoseMessage].at(0)["state"], "fix");
}

TEST_F(ConverterTest, PoseWithoutPlace_IsNoPose) {
  convert(R"({"class":"POSE","seq":1,"t":1.5,"state":"lost"})");
  EXPECT_FALSE(messages_.contains(ChannelId::kPose));
  EXPECT_EQ(messages_[ChannelId::kPoseMessage].size(), 1u);
}

TEST_F(ConverterTest, Scan_AscendsEvenlyFromTheEndOfItsLargestGap) {
  // Clockwise, through the seam at pi; nothing ahead of the robot.
  convert(
      R"({"class":"SCAN","t":2,"duration":0.1,"angles":[-2.0,-3.0,2.28,1.28],"ranges":[1,2,3,4],"quality":[1,2,3,4]})");
  const json scan = messages_[ChannelId::kScan].at(0);
  EXPECT_NEAR(scan["start_angle"], 1.28, 1e-5);
  EXPECT_NEAR(scan["end_angle"], 2 * core::kPi - 2, 1e-5);
  EXPECT_EQ(scan["ranges"], json::parse("[4,3,2,1]"));
  EXPECT_EQ(scan["intensities"], json::parse("[4,3,2,1]"));
}

TEST_F(ConverterTest, Map_IsOneEntityOfCubes) {
  convert(
      R"({"class":"MAP","name":"a","hash":"","thickness":0.1,"walls":[{"from":[0,0],"to":[0,2]}],"rooms":[]})");
  const json update = messages_[ChannelId::kWalls].at(0);
  const json cube = update["entities"][0]["cubes"][0];
  EXPECT_EQ(cube["pose"]["position"]["y"], 1);
  EXPECT_NEAR(cube["size"]["x"], 2.1, 1e-9);
  EXPECT_EQ(times_[ChannelId::kWalls], 7);
}

TEST_F(ConverterTest, OtherAndDamagedLines_AreNothing) {
  for (const char* line : {"", "{", R"({"class":"POSE"})", R"({"class":"SERIAL","t":1,"rx":"00"})",
                           R"({"class":"SCAN","t":1,"duration":1,"angles":[],"ranges":[]})"}) {
    convert(line);
  }
  EXPECT_TRUE(messages_.empty());
}

TEST(Channels, Schemas_AreJson) {
  for (std::size_t i = 0; i < channels().size(); ++i) {
    EXPECT_EQ(static_cast<std::size_t>(channels()[i].id), i + 1);
    EXPECT_EQ(json::parse(channels()[i].schema)["type"], "object") << channels()[i].topic;
  }
}

}  // namespace
}  // namespace cornerd::foxglove
