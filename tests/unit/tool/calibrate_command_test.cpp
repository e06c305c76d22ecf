// SPDX-License-Identifier: MIT
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include "command_run.hpp"
#include "settings/noise.hpp"
#include "temporary_folder.hpp"
#include "tool/failure.hpp"
#include "xml_check.hpp"

namespace cornerd::tool {
namespace {

using testing::HasSubstr;

class CalibrateNoise : public testing::Test {
 protected:
  std::string path(const std::string& name) const { return (folder_.path() / name).string(); }
  std::string text_of(const std::string& name) const {
    std::ostringstream text;
    text << std::ifstream(path(name)).rdbuf();
    return text.str();
  }
  /// A lidar with known noise stands still in a hall.
  std::string recording(const std::string& floor, const std::string& turns = "100") const {
    std::ofstream(path("hall.json")) << R"({"format": "cornerd-map", "version": 1, "name": "hall",
        "walls": [{"from": [0, 0], "to": [6, 0]}, {"from": [6, 0], "to": [6, 4]},
                  {"from": [6, 4], "to": [0, 4]}, {"from": [0, 4], "to": [0, 0]}]})";
    CommandRun({"simulate", "--map", path("hall.json"), "--wire", "standard", "--pose", "2,0.6,0.3",
                "--turns", turns, "--sigma-floor", floor, "--sigma-share", "0.002",
                "--bearing-noise", "0.15", "-o", path("still.bin")});
    return path("still.bin");
  }

  TemporaryFolder folder_;
};

TEST_F(CalibrateNoise, SimulatedLidar_GivesBackItsNoiseAsAFileThatSimulateTakes) {
  const CommandRun run({"calibrate", "noise", recording("0.002"), "-o", path("noise.json"),
                        "--plot", path("noise.svg")});
  ASSERT_EQ(run.exit_code, kExitDone) << run.err;
  EXPECT_THAT(run.out, HasSubstr("directions"));
  EXPECT_THAT(run.err, HasSubstr("still.bin: "));
  EXPECT_THAT(run.err, Not(HasSubstr("warning")));
  const core::SensorNoise noise = settings::load_noise(path("noise.json"));
  EXPECT_NEAR(noise.floor_m, 0.002, 0.0003);
  EXPECT_NEAR(noise.share, 0.002, 0.0003);
  EXPECT_NEAR(core::degrees(noise.bearing_rad), 0.15, 0.02);
  EXPECT_EQ(find_xml_error(text_of("noise.svg")), "");
  EXPECT_EQ(CommandRun({"simulate", "--map", path("hall.json"), "--pose", "2,0.6,0.3", "--noise",
                        path("noise.json"), "-o", path("again.bin")})
                .exit_code,
            kExitDone);
}

TEST_F(CalibrateNoise, Model_ChoosesWhatIsWritten) {
  const std::string file = recording("0.002");
  CommandRun({"calibrate", "noise", file, "--model", "plain", "-o", path("plain.json")});
  CommandRun({"calibrate", "noise", file, "--model", "table", "-o", path("table.json")});
  EXPECT_THAT(text_of("plain.json"), Not(HasSubstr("ranges")));
  EXPECT_THAT(text_of("table.json"), HasSubstr("ranges"));
  EXPECT_NEAR(settings::load_noise(path("table.json")).sigma_range_m(0.7), 0.002, 0.0003);
}

TEST_F(CalibrateNoise, TooFewTurns_AreAFailureThatSaysWhatToDo) {
  const CommandRun run({"calibrate", "noise", recording("0.002", "3"), "-o", path("noise.json")});
  EXPECT_EQ(run.exit_code, kExitFailed);
  EXPECT_THAT(run.err, HasSubstr("record some 20 turns"));
  EXPECT_EQ(run.out, "");
  EXPECT_FALSE(std::filesystem::exists(path("noise.json")));
}

TEST_F(CalibrateNoise, WrongUsage_EndsWith2) {
  EXPECT_EQ(CommandRun({"calibrate"}).exit_code, kExitUsage);
  EXPECT_EQ(CommandRun({"calibrate", "noise"}).exit_code, kExitUsage);
  EXPECT_EQ(CommandRun({"calibrate", "noise", "x.bin", "--model", "best"}).exit_code, kExitUsage);
  EXPECT_EQ(CommandRun({"calibrate", "noise", path("absent.bin")}).exit_code, kExitFailed);
}

}  // namespace
}  // namespace cornerd::tool
