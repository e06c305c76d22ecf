// SPDX-License-Identifier: MIT
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <string>
#include <utility>

#include <nlohmann/json.hpp>

#include "core/geometry/angle.hpp"
#include "odometry_command.hpp"

namespace cornerd::tool {
namespace {

using nlohmann::json;
using testing::HasSubstr;

class CalibrateMount : public OdometryCommandTest {
 protected:
  void SetUp() override {
    ASSERT_EQ(simulate({"--acceleration", "1", "--set", "/lidar/mount/x=0.06", "--set",
                        "/lidar/mount/y=-0.03", "--set", "/lidar/mount/theta=0.3"},
                       "400")
                  .exit_code,
              0);
  }
  CommandRun calibrate(const std::string& file) {
    return CommandRun({"calibrate", "mount", file, "--map", map_, "-o", output_});
  }
  const std::string output_ = folder_ / "mount.json";
};

TEST_F(CalibrateMount, UnknownMount_IsFoundAndReplays) {
  const CommandRun run = calibrate(recording_);
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const json mount = json::parse(std::ifstream(output_))["lidar"]["mount"];
  EXPECT_NEAR(mount["x"].get<double>(), 0.06, 0.003);
  EXPECT_NEAR(mount["y"].get<double>(), -0.03, 0.006);
  EXPECT_NEAR(mount["theta"].get<double>(), 0.3, core::radians(0.3));
  EXPECT_EQ(mount["inverted"], false);
  EXPECT_EQ(CommandRun({"replay", recording_, "--config", output_, "--map", map_}).exit_code, 0);
}

TEST_F(CalibrateMount, OdometryOfAnotherFile_GivesTheSame) {
  ASSERT_EQ(calibrate(recording_).exit_code, 0);
  const json own = json::parse(std::ifstream(output_))["lidar"]["mount"];
  const std::string bare = folder_ / "bare.ndjson";
  rewrite(bare, [](json& line) { line["class"] = "EVENT"; });
  const CommandRun run(
      {"calibrate", "mount", bare, "--map", map_, "--odometry", recording_, "-o", output_});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const json other = json::parse(std::ifstream(output_))["lidar"]["mount"];
  // Readings of another file come by their times, not by their lines.
  for (const char* key : {"x", "y", "theta"}) {
    EXPECT_NEAR(other[key].get<double>(), own[key].get<double>(), 5e-4) << key;
  }
}

TEST_F(CalibrateMount, WrongWheels_AreNamedFirst) {
  const std::string wrong = folder_ / "wrong.ndjson";
  rewrite(wrong, [](json& line) { line["left"] = -line["left"].get<int>(); });
  const CommandRun run = calibrate(wrong);
  EXPECT_EQ(run.exit_code, 1);
  EXPECT_THAT(run.err, HasSubstr("odometry first: the left counts go backward"));
}

TEST_F(CalibrateMount, DriveWithoutOdometry_FailsWithReason) {
  const std::string bare = folder_ / "bare.ndjson";
  rewrite(bare, [](json& line) { line["class"] = "EVENT"; });
  const CommandRun run = calibrate(bare);
  EXPECT_EQ(run.exit_code, 1);
  EXPECT_THAT(run.err, HasSubstr("no ODOMETRY line with left and right"));
}

}  // namespace
}  // namespace cornerd::tool
