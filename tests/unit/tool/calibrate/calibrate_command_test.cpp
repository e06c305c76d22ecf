// SPDX-License-Identifier: MIT
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <random>
#include <sstream>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "command_run.hpp"
#include "tests/temporary_folder.hpp"
#include "tool/command_line/failure.hpp"
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
  std::string recording(const std::string& floor, const std::string& scans = "100") const {
    std::ofstream(path("hall.json")) << R"({"format": "cornerd-map", "version": 1, "name": "hall",
        "walls": [{"from": [0, 0], "to": [6, 0]}, {"from": [6, 0], "to": [6, 4]},
                  {"from": [6, 4], "to": [0, 4]}, {"from": [0, 4], "to": [0, 0]}]})";
    CommandRun({"simulate", "--map", path("hall.json"), "--wire", "standard", "--pose", "2,0.6,0.3",
                "--scans", scans, "--sigma-floor", floor, "--sigma-share", "0.002",
                "--bearing-noise", "0.15", "-o", path("still.bin")});
    return path("still.bin");
  }

  test::TemporaryFolder folder_;
};

TEST_F(CalibrateNoise, SimulatedLidar_NoiseIsEstimatedAndWrittenForSimulate) {
  const CommandRun run({"calibrate", "noise", recording("0.002"), "-o", path("noise.json"),
                        "--plot", path("noise.svg")});
  ASSERT_EQ(run.exit_code, kExitDone) << run.err;
  EXPECT_THAT(run.out, HasSubstr("directions"));
  EXPECT_THAT(run.err, HasSubstr("still.bin: "));
  EXPECT_THAT(run.err, Not(HasSubstr("warning")));
  const core::SensorNoise noise = settings::load_noise(path("noise.json")).sensor;
  EXPECT_NEAR(noise.floor_m, 0.002, 0.0003);
  EXPECT_NEAR(noise.share, 0.002, 0.0003);
  EXPECT_NEAR(core::degrees(noise.bearing_rad), 0.15, 0.02);
  EXPECT_EQ(find_xml_error(text_of("noise.svg")), "");
  EXPECT_EQ(CommandRun({"simulate", "--map", path("hall.json"), "--pose", "2,0.6,0.3", "--noise",
                        path("noise.json"), "-o", path("again.bin")})
                .exit_code,
            kExitDone);
}

TEST_F(CalibrateNoise, Model_PlainOrTable_SelectsWhatIsWritten) {
  const std::string file = recording("0.002");
  CommandRun({"calibrate", "noise", file, "--model", "plain", "-o", path("plain.json")});
  CommandRun({"calibrate", "noise", file, "--model", "table", "-o", path("table.json")});
  EXPECT_THAT(text_of("plain.json"), Not(HasSubstr("ranges")));
  EXPECT_THAT(text_of("table.json"), HasSubstr("ranges"));
  EXPECT_NEAR(settings::load_noise(path("table.json")).sensor.sigma_range_m(0.7), 0.002, 0.0003);
}

TEST_F(CalibrateNoise, TooFewScans_FailWithRemedy) {
  const CommandRun run({"calibrate", "noise", recording("0.002", "1"), "-o", path("noise.json")});
  EXPECT_EQ(run.exit_code, kExitFailed);
  EXPECT_THAT(run.err, HasSubstr("record 20 scans"));
  EXPECT_EQ(run.out, "");
  EXPECT_FALSE(std::filesystem::exists(path("noise.json")));
}

TEST_F(CalibrateNoise, ScatteredReturns_FailWithReason) {
  {
    std::mt19937 random(3);
    std::uniform_real_distribution<double> range_m(0.3, 6);
    std::ofstream file(path("chance.ndjson"));
    for (int k = 0; k < 60; ++k) {
      nlohmann::json scan = {{"class", "SCAN"}, {"t", 0.2 * k}, {"duration", 0.18}};
      for (int i = 0; i < 300; ++i) {
        scan["angles"].push_back(0.02 * i);
        scan["ranges"].push_back(range_m(random));
      }
      file << scan << '\n';
    }
  }
  const CommandRun run({"calibrate", "noise", path("chance.ndjson"), "-o", path("noise.json")});
  EXPECT_EQ(run.exit_code, kExitFailed);
  EXPECT_THAT(run.err, HasSubstr("too scattered for walls"));
  EXPECT_FALSE(std::filesystem::exists(path("noise.json")));
}

TEST_F(CalibrateNoise, WallsAtKnownDistances_GiveTheSimulatedWallModel) {
  recording("0.002", "1");
  std::ofstream(path("truth.json")) << R"({"lidar": {"noise": {"bearing": 0, "wall": [
      {"from": 0.1, "to": 0.6, "ray": 1.2, "sigma": 0.001,
       "coefficients": [[0.002], [0], [0, 0.004]]},
      {"from": 0.6, "to": 2.25, "ray": 1.2, "sigma": 0.003,
       "coefficients": [[-0.002, 0.003], [0], [0.002]]}]}}})";
  std::vector<std::string> words = {"calibrate",        "noise",         "-o",
                                    path("noise.json"), "--plot",        path("noise.svg"),
                                    "--plot-wall",      path("wall.svg")};
  for (const char* distance :
       {"0.2", "0.3", "0.4", "0.5", "0.59", "0.8", "0.9", "1.2", "1.6", "2.0"}) {
    const std::string file = path(std::string("wall-") + distance + ".bin");
    const CommandRun run({"simulate", "--map", path("hall.json"), "--wire", "standard", "--pose",
                          std::string("3,") + distance + ",0", "--scans", "10", "--noise",
                          path("truth.json"), "--outliers", "0", "-o", file});
    ASSERT_EQ(run.exit_code, kExitDone) << run.err;
    words.push_back(file + "@" + distance);
  }
  const CommandRun run(words);
  ASSERT_EQ(run.exit_code, kExitDone) << run.err;
  EXPECT_THAT(run.out, HasSubstr("wall at [m]"));
  EXPECT_THAT(run.out, HasSubstr("beyond 3 sigma"));
  const calibration::WallModel truth = settings::load_noise(path("truth.json")).wall;
  const calibration::WallModel found = settings::load_noise(path("noise.json")).wall;
  for (const double distance_m : {0.25, 0.4, 0.55, 0.85, 1.3, 1.9}) {
    for (const double ray_rad : {-0.9, -0.4, 0.0, 0.4, 0.9}) {
      EXPECT_NEAR(found.error_m(distance_m, ray_rad), truth.error_m(distance_m, ray_rad), 0.0012)
          << distance_m << ' ' << ray_rad;
    }
    EXPECT_NEAR(found.sigma_m(distance_m), truth.sigma_m(distance_m),
                0.15 * truth.sigma_m(distance_m));
  }
  EXPECT_EQ(find_xml_error(text_of("noise.svg")), "");
  EXPECT_EQ(find_xml_error(text_of("wall.svg")), "");
}

TEST_F(CalibrateNoise, PaperModelWithoutDistances_UsesFoundWalls) {
  const std::string file = recording("0.002");
  const CommandRun run({"calibrate", "noise", file, "--model", "paper", "-o", path("noise.json"),
                        "--plot-wall", path("wall.svg")});
  ASSERT_EQ(run.exit_code, kExitDone) << run.err;
  EXPECT_THAT(run.out, HasSubstr("distances are fitted"));
  // Walls at 0.6 and 2 m; the simulated lidar has noise only.
  const calibration::WallModel found = settings::load_noise(path("noise.json")).wall;
  ASSERT_FALSE(found.empty());
  for (const double distance_m : {0.6, 2.0}) {
    for (const double ray_rad : {-0.5, 0.0, 0.5}) {
      EXPECT_NEAR(found.error_m(distance_m, ray_rad), 0, 0.001) << distance_m << ' ' << ray_rad;
    }
  }
  EXPECT_EQ(find_xml_error(text_of("wall.svg")), "");
  CommandRun({"calibrate", "noise", file, "-o", path("noise.json")});
  EXPECT_THAT(text_of("noise.json"), Not(HasSubstr("wall")));
}

TEST_F(CalibrateNoise, NoWallAtDistanceOrInvalidDistance_Fails) {
  const std::string file = recording("0.002");
  const CommandRun absent({"calibrate", "noise", file + "@11"});
  EXPECT_EQ(absent.exit_code, kExitFailed);
  EXPECT_THAT(absent.err, HasSubstr("no straight wall at 11.000 m"));
  for (const char* distance : {"@nan", "@inf", "@0", "@-1", "@1m", "@", "@100"}) {
    EXPECT_EQ(CommandRun({"calibrate", "noise", file + distance}).exit_code, kExitUsage)
        << distance;
  }
}

TEST_F(CalibrateNoise, WrongUsage_ExitCode2) {
  EXPECT_EQ(CommandRun({"calibrate"}).exit_code, kExitUsage);
  EXPECT_EQ(CommandRun({"calibrate", "noise"}).exit_code, kExitUsage);
  EXPECT_EQ(CommandRun({"calibrate", "noise", "x.bin", "--model", "best"}).exit_code, kExitUsage);
  EXPECT_EQ(CommandRun({"calibrate", "noise", path("absent.bin")}).exit_code, kExitFailed);
}

/// A biased lidar at rest at several poses in the arena.
class CalibrateBias : public CalibrateNoise {
 protected:
  std::string biased_recording(const std::string& places,
                               const std::string& scale = "1.008") const {
    CommandRun({"simulate", "--map", map_, "--places", places, "--scans-each", "20",
                "--range-scale", scale, "--range-offset", "0.004", "-o", path("places.ndjson")});
    return path("places.ndjson");
  }

  const std::string map_ = CORNERD_SOURCE_DIR "/config/maps/krpai-2019-a.json";
};

TEST_F(CalibrateBias, BiasedLidar_ReportsAndWritesBias) {
  const CommandRun run(
      {"calibrate", "bias", biased_recording("12"), "--map", map_, "-o", path("bias.json")});
  ASSERT_EQ(run.exit_code, kExitDone) << run.err;
  EXPECT_THAT(run.out, HasSubstr("range offset, mm"));
  const auto bias = nlohmann::json::parse(text_of("bias.json"))["advanced"]["lidar"]["bias"];
  EXPECT_NEAR(bias["range_scale"], 0.008, 0.002);
  EXPECT_NEAR(bias["range_offset"], 0.004, 0.002);
}

TEST_F(CalibrateBias, MapNotToScale_FailsAndWritesNothing) {
  const CommandRun run({"calibrate", "bias", biased_recording("12", "1.04"), "--map", map_, "-o",
                        path("bias.json")});
  EXPECT_EQ(run.exit_code, kExitFailed);
  EXPECT_THAT(run.err, HasSubstr("to scale"));
  EXPECT_FALSE(std::filesystem::exists(path("bias.json")));
}

TEST_F(CalibrateBias, TooFewScans_Fail) {
  const CommandRun run({"calibrate", "bias", recording("0.002", "5"), "--map", path("hall.json")});
  EXPECT_EQ(run.exit_code, kExitFailed);
  EXPECT_THAT(run.err, HasSubstr("scans were localized"));
}

}  // namespace
}  // namespace cornerd::tool
