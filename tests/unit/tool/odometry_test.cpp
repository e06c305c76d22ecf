// SPDX-License-Identifier: MIT
// Simulated drives with wheels and a gyro, from the recording to the pose.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <functional>
#include <utility>

#include <nlohmann/json.hpp>

#include "command_run.hpp"
#include "tests/temporary_folder.hpp"

namespace cornerd::tool {
namespace {

using nlohmann::json;
using testing::HasSubstr;

class OdometryCommandTest : public ::testing::Test {
 protected:
  CommandRun simulate(std::vector<std::string> more, const std::string& turns = "150") {
    std::vector<std::string> words = {
        "simulate", "--map",    map_,      "--scenario", "circuit-1",  "--turns",       turns,
        "-o",       recording_, "--truth", truth_,       "--odometry", "--drive-speed", "0.4"};
    words.insert(words.end(), more.begin(), more.end());
    return CommandRun(words);
  }
  CommandRun replay(std::vector<std::string> more) {
    std::vector<std::string> words = {"replay", recording_, "--map", map_, "--truth", truth_};
    words.insert(words.end(), more.begin(), more.end());
    return CommandRun(words);
  }
  /// The recording with each ODOMETRY line changed.
  void rewrite(const std::string& file, const std::function<void(json& line)>& change) const {
    std::ifstream from(recording_);
    std::ofstream to(file);
    for (std::string text; std::getline(from, text);) {
      json line = json::parse(text);
      if (line["class"] == "ODOMETRY") change(line);
      to << line.dump() << '\n';
    }
  }
  static std::size_t count(const std::string& text, const std::string& what) {
    std::size_t found = 0;
    for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + 1)) {
      ++found;
    }
    return found;
  }

  test::TemporaryFolder folder_;
  const std::string map_ = CORNERD_SOURCE_DIR "/config/maps/flat-7.json";
  const std::string recording_ = (folder_.path() / "drive.ndjson").string();
  const std::string truth_ = (folder_.path() / "truth.ndjson").string();
};

TEST_F(OdometryCommandTest, CoveredLidar_IsBridgedByTheRecordedOdometry) {
  ASSERT_EQ(simulate({"--covered", "15,17"}).exit_code, 0);
  const CommandRun without = replay({});
  EXPECT_EQ(count(without.out, "\"state\":\"predicted\""), 0U);
  EXPECT_EQ(count(without.out, "\"odometry\""), 0U);
  const CommandRun with = replay({"--set", "/odometry/source=socket"});
  EXPECT_NEAR(static_cast<double>(count(with.out, "\"state\":\"predicted\"")), 15, 2);
  EXPECT_EQ(count(with.out, "\"state\":\"lost\""), 0U);
  EXPECT_NE(with.err.find("wrong            0"), std::string::npos) << with.err;
  EXPECT_NE(with.out.find("\"odometry\":{\"state\":\"running\""), std::string::npos);
}

TEST_F(OdometryCommandTest, StatusAlone_SaysWhatWasLearnt) {
  ASSERT_EQ(simulate({"--wheel-errors", "0.015,0.025"}).exit_code, 0);
  const std::vector<std::string> words = {"replay", recording_, "--set", "/odometry/source=socket",
                                          "--classes"};
  const auto odometry_of = [&](const std::vector<std::string>& more) {
    std::vector<std::string> all = words;
    all.insert(all.end(), more.begin(), more.end());
    const std::string out = CommandRun(all).out;
    const std::size_t last = out.rfind("{\"class\":\"STATUS\"");
    return last == std::string::npos ? json() : json::parse(out.substr(last))["odometry"];
  };
  const json alone = odometry_of({"STATUS", "--map", map_});
  EXPECT_NEAR(alone["left_scale"].get<double>(), 0.015, 0.004);
  EXPECT_EQ(alone, odometry_of({"POSE,STATUS", "--map", map_}));
  EXPECT_FALSE(alone.contains("hint"));
  EXPECT_THAT(odometry_of({"STATUS"})["hint"].get<std::string>(), HasSubstr("--map"));
}

TEST_F(OdometryCommandTest, LinesThatLackAWheel_AreHintedAt) {
  ASSERT_EQ(simulate({}).exit_code, 0);
  const std::string wrong = folder_ / "wrong.ndjson";
  rewrite(wrong, [](json& line) { line.erase("left"); });
  const CommandRun run({"replay", wrong, "--map", map_, "--set", "/odometry/source=socket"});
  EXPECT_THAT(run.out, HasSubstr(R"("odometry":{"state":"absent","hint":"lines lack left: )"));
}

TEST_F(OdometryCommandTest, AnotherFile_GoesBeforeTheRecordingsOwn) {
  ASSERT_EQ(simulate({"--covered", "15,17"}).exit_code, 0);
  const std::string same = replay({"--set", "/odometry/source=socket"}).out;
  // In a recording a reading stands where it arrived, in a file of its own by its time.
  EXPECT_EQ(count(replay({"--odometry", recording_}).out, "\"state\":\"predicted\""),
            count(same, "\"state\":\"predicted\""));
  const std::string nothing = (folder_.path() / "none.ndjson").string();
  std::ofstream(nothing) << "{\"t\":0,\"x\":0,\"y\":0,\"theta\":0}\n{\"class\":\"POSE\"}\n";
  EXPECT_EQ(replay({"--odometry", nothing}).exit_code, 1);
}

TEST_F(OdometryCommandTest, PapersModes_BridgeToo) {
  ASSERT_EQ(simulate({"--covered", "15,16"}).exit_code, 0);
  for (const char* mode : {"encoder", "gyro", "mean", "weighted"}) {
    const CommandRun run = replay({"--set", "/odometry/source=socket", "--set",
                                   std::string("/odometry/mode=\"") + mode + "\""});
    EXPECT_GT(count(run.out, "\"state\":\"predicted\""), 4U) << mode << run.err;
  }
}

TEST_F(OdometryCommandTest, Readings_AreInTheOrderOfTime) {
  ASSERT_EQ(simulate({"--no-gyro", "--odometry-rate", "100"}).exit_code, 0);
  std::ifstream stream(recording_);
  double last_s = -1;
  std::size_t readings = 0;
  for (std::string text; std::getline(stream, text);) {
    const json line = json::parse(text);
    EXPECT_GE(line["t"].get<double>(), last_s);
    last_s = line["t"];
    if (line["class"] != "ODOMETRY") continue;
    ++readings;
    EXPECT_FALSE(line.contains("gyro"));
  }
  EXPECT_NEAR(static_cast<double>(readings), 100 * last_s, 3);
}

TEST_F(OdometryCommandTest, Calibrate_WritesWhatAReplayReads) {
  ASSERT_EQ(
      simulate({"--wheel-errors", "0.015,0.025", "--gyro-error", "0.02", "--gyro-bias", "0.01"},
               "300")
          .exit_code,
      0);
  const std::string output = (folder_.path() / "odometry.json").string();
  const CommandRun run({"calibrate", "odometry", recording_, "--map", map_, "-o", output});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_NE(run.out.find("least squares"), std::string::npos);
  EXPECT_NE(run.out.find("weighted"), std::string::npos);
  std::ifstream stream(output);
  const json start = json::parse(stream)["odometry"]["start"];
  EXPECT_NEAR(start["left_scale"].get<double>(), 0.015, 0.003);
  EXPECT_NEAR(start["right_scale"].get<double>(), 0.025, 0.003);
  EXPECT_NEAR(start["gyro_scale"].get<double>(), 0.02, 0.006);  // turns one way alone
  EXPECT_NEAR(start["gyro_bias"].get<double>(), 0.01, 0.001);

  const CommandRun by_truth({"calibrate", "odometry", recording_, "--truth", truth_, "-o", output});
  EXPECT_EQ(by_truth.exit_code, 0) << by_truth.err;
  EXPECT_EQ(CommandRun({"replay", recording_, "--config", output, "--map", map_}).exit_code, 0);
}

TEST_F(OdometryCommandTest, CalibrateOfReadingsThatAreLate_FindsByHowMuch) {
  ASSERT_EQ(simulate({"--wheel-errors", "0.015,0.025", "--gyro-error", "0.02", "--acceleration",
                      "1", "--turn-acceleration", "6"},
                     "300")
                .exit_code,
            0);
  const std::string late = folder_ / "late.ndjson";
  const std::string output = folder_ / "odometry.json";
  const auto calibrate = [&](double late_s) {
    std::filesystem::remove(output);
    rewrite(late, [&](json& line) { line["t"] = line["t"].get<double>() + late_s; });
    return CommandRun({"calibrate", "odometry", late, "--map", map_, "-o", output});
  };
  const auto start = [&] { return json::parse(std::ifstream(output))["odometry"]["start"]; };
  ASSERT_EQ(calibrate(0).exit_code, 0);
  EXPECT_FALSE(start().contains("delay"));
  for (const double late_s : {-0.1, 0.02}) {
    const CommandRun run = calibrate(late_s);
    ASSERT_EQ(run.exit_code, 0) << run.err;
    EXPECT_NEAR(start()["delay"].get<double>(), late_s, 0.003);
    EXPECT_NEAR(start()["gyro_scale"].get<double>(), 0.02, 0.003) << run.out;
    EXPECT_EQ(CommandRun({"replay", late, "--config", output, "--map", map_}).exit_code, 0);
  }
  const CommandRun beyond = calibrate(0.4);
  EXPECT_THAT(beyond.out, HasSubstr("The readings are 0.40 s late, by more than"));
  EXPECT_FALSE(start().contains("delay"));
  EXPECT_NEAR(start()["gyro_scale"].get<double>(), 0.02, 0.003) << "of the right times";
  const CommandRun edge = calibrate(0.8);
  EXPECT_EQ(edge.exit_code, 1);
  EXPECT_THAT(edge.err, HasSubstr("0.6 s late or more, the most that is looked for"));
  EXPECT_FALSE(std::filesystem::exists(output));
}

TEST_F(OdometryCommandTest, CalibrateOfARobotThatIsFarOff_NamesWhatToChange) {
  ASSERT_EQ(simulate({"--wheel-errors", "0.015,0.025", "--gyro-bias", "0.01"}, "300").exit_code, 0);
  const std::string wrong = folder_ / "wrong.ndjson";
  const std::string output = folder_ / "odometry.json";
  const auto calibrate = [&](const std::function<void(json & line)>& change) {
    rewrite(wrong, change);
    const CommandRun run({"calibrate", "odometry", wrong, "--map", map_, "-o", output});
    EXPECT_EQ(run.exit_code, 1) << run.err;
    EXPECT_FALSE(std::filesystem::exists(output));
    return run.err;
  };
  const auto scale = [](json& line, int factor) {
    for (const char* wheel : {"left", "right"}) line[wheel] = line[wheel].get<int>() * factor;
  };
  EXPECT_THAT(calibrate([&](json& line) { scale(line, 4); }),
              HasSubstr("odometry.counts_per_turn to 5760"));
  EXPECT_THAT(calibrate([&](json& line) { scale(line, 2); }),
              HasSubstr("odometry.counts_per_turn to 2880"));
  // Faster than a wheel can turn: all of it is refused by the daemon.
  EXPECT_THAT(calibrate([&](json& line) { scale(line, 16); }),
              HasSubstr("odometry.counts_per_turn to 23040"));
  EXPECT_THAT(calibrate([&](json& line) { std::swap(line["left"], line["right"]); }),
              HasSubstr("left and right are exchanged: swap"));
  EXPECT_THAT(calibrate([&](json& line) { scale(line, -1); }), HasSubstr("both wheels count back"));
  EXPECT_THAT(calibrate([](json& line) { line["gyro"] = line["gyro"].get<double>() * 57.3; }),
              HasSubstr("degrees a second"));
  EXPECT_THAT(calibrate([](json& line) { line["gyro"] = line["gyro"].get<double>() + 0.6; }),
              HasSubstr("+0.61 rad/s while the robot stands"));
  EXPECT_THAT(calibrate([](json& line) { line.erase("right"); }),
              HasSubstr("none of its ODOMETRY lines has both left and right"));
}

TEST_F(OdometryCommandTest, CalibrateWithoutOdometry_Fails) {
  const CommandRun simulated({"simulate", "--map", map_, "--pose", "1.6,2,0", "-o", recording_});
  ASSERT_EQ(simulated.exit_code, 0);
  const CommandRun run({"calibrate", "odometry", recording_, "--map", map_});
  EXPECT_EQ(run.exit_code, 1);
  EXPECT_NE(run.err.find("no odometry"), std::string::npos);
}

TEST_F(OdometryCommandTest, WrongUse_IsNamed) {
  EXPECT_EQ(simulate({"--wheel-errors", "1"}).exit_code, 2);
  EXPECT_EQ(simulate({"--wheel-errors", "0.9,0"}).exit_code, 2);
  EXPECT_EQ(simulate({"--wheel-errors", "nan,0"}).exit_code, 2);
  EXPECT_EQ(simulate({"--covered", "5,4"}).exit_code, 2);
  EXPECT_EQ(simulate({"--gyro-bias", "nan"}).exit_code, 2);
  EXPECT_EQ(simulate({"--path", "1,1 2,1"}).exit_code, 2);
  const std::string bytes = (folder_.path() / "x.bin").string();
  EXPECT_EQ(CommandRun({"simulate", "--map", map_, "--pose", "1,1,0", "--odometry", "-o", bytes})
                .exit_code,
            2);
  EXPECT_EQ(CommandRun({"simulate", "--map", map_, "--places", "3", "--odometry", "-o", recording_})
                .exit_code,
            2);
}

}  // namespace
}  // namespace cornerd::tool
