// SPDX-License-Identifier: MIT
// A drive is simulated and surveyed, and a second one is localized in the map.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include <nlohmann/json.hpp>

#include "command_run.hpp"
#include "settings/map_file.hpp"
#include "tests/temporary_folder.hpp"
#include "tool/replay/truth.hpp"
#include "xml_check.hpp"

namespace cornerd::tool {
namespace {

class SurveyCommandTest : public ::testing::Test {
 protected:
  std::string file(const std::string& name) const { return (folder_.path() / name).string(); }
  static std::string content(const std::string& name) {
    std::ifstream stream(name);
    std::ostringstream text;
    text << stream.rdbuf();
    return text.str();
  }
  void simulate(const std::string& recording, const std::string& truth, const std::string& seed) {
    ASSERT_EQ(CommandRun({"simulate", "--map", arena_, "--path",
                          "0.9,0.9 0.9,1.5 1.15,1.15 0.9,0.9", "--loop", "--scans", "120",
                          "--odometry", "--seed", seed, "-o", recording, "--truth", truth})
                  .exit_code,
              0);
  }
  /// Lines before `at_s` to one.ndjson, the rest to two.ndjson with a restarted clock, and the
  /// readings of the first to one.odometry.
  void split_in_two(const std::string& whole, double at_s) const {
    std::ifstream lines(whole);
    std::ofstream one(file("one.ndjson"));
    std::ofstream two(file("two.ndjson"));
    std::ofstream odometry(file("one.odometry"));
    const std::string time = "\"t\":";
    for (std::string line; std::getline(lines, line);) {
      const std::size_t begin = line.find(time) + time.size();
      const std::size_t end = line.find(',', begin);
      const double t_s = std::stod(line.substr(begin, end - begin));
      if (t_s < at_s) {
        one << line << "\n";
        if (line.find("ODOMETRY") != std::string::npos) odometry << line << "\n";
        continue;
      }
      line.replace(begin, end - begin, std::to_string(t_s - at_s));
      two << line << "\n";
    }
  }

  /// gap.ndjson: without the scans from 5 to 9 s, in which the robot moves, and without the
  /// odometry unless `keeps_odometry`.
  void silence_lidar(const std::string& whole, bool keeps_odometry) const {
    std::ifstream lines(whole);
    std::ofstream gap(file("gap.ndjson"));
    for (std::string line; std::getline(lines, line);) {
      const double t_s = nlohmann::json::parse(line)["t"];
      const bool is_odometry = line.find("ODOMETRY") != std::string::npos;
      if (t_s < 5 || t_s > 9 || (is_odometry && keeps_odometry)) gap << line << "\n";
    }
  }

  test::TemporaryFolder folder_;
  const std::string arena_ = CORNERD_SOURCE_DIR "/config/maps/krpai-2019-a.json";
};

TEST_F(SurveyCommandTest, SimulatedDrive_GivesMapForLocalization) {
  simulate(file("one.ndjson"), file("one.truth"), "1");
  const Truth truth = Truth::load(file("one.truth"));
  constexpr core::TimeNs kMiddleOfTheFirstScan = 91'000'000;
  const core::Pose2 start = truth.at(kMiddleOfTheFirstScan).value();
  std::ostringstream pose;
  pose << start.x_m << "," << start.y_m << "," << start.theta_rad;
  const CommandRun run({"survey", file("one.ndjson"), "-o", file("map.json"), "--start", pose.str(),
                        "--plot", file("map.svg"), "--trajectory", file("trajectory.ndjson")});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_NE(run.out.find("by wheels, gyro and lidar"), std::string::npos);

  EXPECT_EQ(CommandRun({"map", "check", file("map.json"), "--places", "0"}).exit_code, 0);
  EXPECT_EQ(settings::load_map(file("map.json"))->plan().name, "map");
  EXPECT_EQ(find_xml_error(content(file("map.svg"))), "");
  EXPECT_EQ(Truth::load(file("trajectory.ndjson")).points().size(), 120U);

  simulate(file("two.ndjson"), file("two.truth"), "2");
  const CommandRun replay({"replay", file("two.ndjson"), "--map", file("map.json"), "--truth",
                           file("two.truth"), "--classes", "STATUS"});
  EXPECT_NE(replay.err.find("wrong            0"), std::string::npos) << replay.err;
}

TEST_F(SurveyCommandTest, LidarGap_IsDeadReckoned) {
  simulate(file("one.ndjson"), file("one.truth"), "1");
  silence_lidar(file("one.ndjson"), /*keeps_odometry=*/true);
  const CommandRun run({"survey", file("gap.ndjson"), "-o", file("map.json"), "--trajectory",
                        file("trajectory.ndjson")});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const Truth truth = Truth::load(file("one.truth"));
  const auto trajectory = Truth::load(file("trajectory.ndjson")).points();
  const auto is_later = [](const auto& point) { return point.t_ns > 9 * core::kNsPerSecond; };
  const auto after = std::find_if(trajectory.begin(), trajectory.end(), is_later);
  ASSERT_NE(after, trajectory.end());
  const core::Pose2 surveyed = trajectory.front().T_map_base.inverse() * after->T_map_base;
  const core::Pose2 driven =
      truth.at(trajectory.front().t_ns)->inverse() * truth.at(after->t_ns).value();
  EXPECT_GT(driven.translation().norm() + std::abs(driven.theta_rad), 0.3);
  EXPECT_LT((surveyed.translation() - driven.translation()).norm(), 0.01);
  EXPECT_NEAR(core::angle_between(surveyed.theta_rad, driven.theta_rad), 0, core::radians(0.5));
}

TEST_F(SurveyCommandTest, GapOfLidarAndWheels_IsRejected) {
  simulate(file("one.ndjson"), file("one.truth"), "1");
  silence_lidar(file("one.ndjson"), /*keeps_odometry=*/false);
  const CommandRun run({"survey", file("gap.ndjson"), "-o", file("map.json")});
  EXPECT_EQ(run.exit_code, 1) << run.out;
  EXPECT_NE(run.err.find("no scan and no odometry from 4."), std::string::npos) << run.err;
  EXPECT_FALSE(std::filesystem::exists(file("map.json")));
}

TEST_F(SurveyCommandTest, NoScanInRecording_Fails) {
  std::ofstream(file("empty.ndjson")) << "";
  const CommandRun run({"survey", file("empty.ndjson"), "-o", file("map.json")});
  EXPECT_EQ(run.exit_code, 1);
  EXPECT_NE(run.err.find("not one complete scan"), std::string::npos);
}

TEST_F(SurveyCommandTest, InconsistentWheels_AreRejectedWithRemedy) {
  ASSERT_EQ(
      CommandRun({"simulate", "--map", arena_, "--path", "0.9,0.9 0.9,1.5 1.15,1.15 0.9,0.9",
                  "--loop", "--scans", "120", "--odometry", "--drive-speed", "0.3",
                  "--acceleration", "1", "--rotation-acceleration", "3", "-o", file("one.ndjson")})
          .exit_code,
      0);
  std::ofstream(file("wrong.json"))
      << R"({"odometry": {"source": "socket", "counts_per_turn": 300}})";
  const CommandRun run({"survey", file("one.ndjson"), "-o", file("map.json"), "--config",
                        file("wrong.json"), "--manhattan"});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_NE(run.out.find("by the lidar alone\n"), std::string::npos) << run.out;
  EXPECT_NE(run.out.find("WARNING: the odometry contradicts the lidar"), std::string::npos);
  EXPECT_NE(run.out.find("odometry.counts_per_turn"), std::string::npos);
  EXPECT_NE(run.out.find("wall faces are square to each other"), std::string::npos);
}

TEST_F(SurveyCommandTest, InconsistentWheelsWithoutLidarMatch_FailWithRemedy) {
  // A lidar of 7.3 Hz sees the next scan rotated by 31 degrees.
  ASSERT_EQ(CommandRun({"simulate", "--map", arena_, "--path", "0.9,0.9 0.9,1.5 1.15,1.15 0.9,0.9",
                        "--loop", "--scans", "120", "--odometry", "--rotation-speed", "4", "-o",
                        file("one.ndjson")})
                .exit_code,
            0);
  std::ofstream(file("wrong.json"))
      << R"({"odometry": {"source": "socket", "counts_per_turn": 300}})";
  const CommandRun run(
      {"survey", file("one.ndjson"), "-o", file("map.json"), "--config", file("wrong.json")});
  EXPECT_EQ(run.exit_code, 1);
  EXPECT_NE(run.err.find("the odometry contradicts the lidar"), std::string::npos) << run.err;
  EXPECT_NE(run.err.find("drive more slowly"), std::string::npos) << run.err;
}

TEST_F(SurveyCommandTest, WrongWheelRadius_IsEstimatedAndReported) {
  simulate(file("one.ndjson"), file("one.truth"), "1");
  std::ofstream(file("wrong.json"))
      << R"({"odometry": {"source": "socket", "counts_per_turn": 1900}})";
  const CommandRun run(
      {"survey", file("one.ndjson"), "-o", file("map.json"), "--config", file("wrong.json")});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_NE(run.out.find("WARNING: the left wheel differs by +3"), std::string::npos) << run.out;
}

TEST_F(SurveyCommandTest, TooFewScans_FailWithTheirNumber) {
  ASSERT_EQ(CommandRun({"simulate", "--map", arena_, "--path", "0.9,0.9 0.9,1.5", "--scans", "4",
                        "-o", file("a.ndjson")})
                .exit_code,
            0);
  const CommandRun run({"survey", file("a.ndjson"), "-o", file("map.json")});
  EXPECT_EQ(run.exit_code, 1);
  EXPECT_NE(run.err.find("complete scans, and a wall needs"), std::string::npos) << run.err;
  EXPECT_NE(run.err.find("a wall needs 5"), std::string::npos) << run.err;
}

TEST_F(SurveyCommandTest, RestartedClock_FollowsPreviousRecording) {
  simulate(file("whole.ndjson"), file("truth"), "1");
  split_in_two(file("whole.ndjson"), 8.2);
  const CommandRun run({"survey", file("one.ndjson"), file("two.ndjson"), "-o", file("map.json"),
                        "--trajectory", file("trajectory.ndjson")});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_NE(run.err.find("two.ndjson: its clock begins before the end"), std::string::npos);
  core::TimeNs last_ns = -1;
  const Truth trajectory = Truth::load(file("trajectory.ndjson"));
  for (const auto& point : trajectory.points()) {
    EXPECT_GT(point.t_ns, last_ns);
    last_ns = point.t_ns;
  }
  const CommandRun whole({"survey", file("whole.ndjson"), "-o", file("other.json")});
  EXPECT_EQ(settings::load_map(file("map.json"))->plan().walls.size(),
            settings::load_map(file("other.json"))->plan().walls.size());
}

TEST_F(SurveyCommandTest, OdometryFileWithRestartedClock_NamesTheFiles) {
  simulate(file("whole.ndjson"), file("truth"), "1");
  split_in_two(file("whole.ndjson"), 8.2);
  const CommandRun run({"survey", file("one.ndjson"), file("two.ndjson"), "-o", file("map.json"),
                        "--odometry", file("one.odometry")});
  EXPECT_EQ(run.exit_code, 1);
  EXPECT_NE(run.err.find("two.ndjson: its clock begins"), std::string::npos) << run.err;
  EXPECT_NE(run.err.find("one.odometry are ambiguous"), std::string::npos) << run.err;
}

TEST_F(SurveyCommandTest, OneRecordingWithoutScan_IsNamed) {
  simulate(file("one.ndjson"), file("truth"), "1");
  std::ofstream(file("two.ndjson")) << R"({"class":"ODOMETRY","t":0.000000,"left":0,"right":0})"
                                    << "\n";
  const CommandRun run({"survey", file("one.ndjson"), file("two.ndjson"), "-o", file("map.json")});
  EXPECT_EQ(run.exit_code, 1);
  EXPECT_NE(run.err.find("two.ndjson: not one complete scan"), std::string::npos) << run.err;
  EXPECT_NE(run.err.find("--odometry"), std::string::npos) << run.err;
}

TEST_F(SurveyCommandTest, WrongUsage_IsReportedBeforeTheWork) {
  std::ofstream(file("a.ndjson")) << "";
  const auto expect = [&](const std::vector<std::string>& more, const std::string& message) {
    std::vector<std::string> words = {"survey", file("a.ndjson"), "-o", file("m.json")};
    words.insert(words.end(), more.begin(), more.end());
    const CommandRun run(words);
    EXPECT_EQ(run.exit_code, 2) << message;
    EXPECT_NE(run.err.find(message), std::string::npos) << run.err;
  };
  expect({"--start", "nan,0,0"}, "is no pose");
  expect({"--start", "500000,4000000,0.3"}, "--start: ");
  expect({"--method", "ransac", "--manhattan"}, "--manhattan: ");
  expect({"--iterations", "5"}, "--iterations: ");
  expect({"--plot", "-"}, "-: ");
}

TEST_F(SurveyCommandTest, InvalidMap_IsNotWritten) {
  simulate(file("one.ndjson"), file("truth"), "1");
  const auto expect = [&](const std::vector<std::string>& more, const std::string& message) {
    std::vector<std::string> words = {"survey",       file("one.ndjson"),
                                      "-o",           file("map.json"),
                                      "--trajectory", file("trajectory.ndjson")};
    words.insert(words.end(), more.begin(), more.end());
    const CommandRun run(words);
    EXPECT_EQ(run.exit_code, 1) << message;
    EXPECT_NE(run.err.find(message), std::string::npos) << run.err;
    EXPECT_FALSE(std::filesystem::exists(file("map.json")));
    EXPECT_FALSE(std::filesystem::exists(file("trajectory.ndjson")));
  };
  expect({"--start", "9999.9,0,0"}, "coordinates must be from -10000 to 10000 metres");
  expect({"--name", std::string(200, 'x')}, "/name: ");
}

TEST_F(SurveyCommandTest, MapOnStandardOutput_ReportOnStandardError) {
  simulate(file("one.ndjson"), file("truth"), "1");
  const CommandRun run({"survey", file("one.ndjson"), "-o", "-"});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_EQ(settings::parse_map(run.out, "map.json")->plan().name, "map");
  EXPECT_NE(run.err.find("by wheels, gyro and lidar"), std::string::npos) << run.err;
  EXPECT_FALSE(std::filesystem::exists("-"));
}

}  // namespace
}  // namespace cornerd::tool
