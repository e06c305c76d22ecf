// SPDX-License-Identifier: MIT
// Faults of wheels and gyro from a recording's lines to the pose: absent, wrapping, jumping, stuck,
// invalid and mistimed values. None may cause a wrong pose.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <functional>
#include <map>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "core/geometry/angle.hpp"
#include "tests/temporary_folder.hpp"
#include "tests/unit/tool/command_run.hpp"
#include "tool/replay/truth.hpp"

namespace cornerd::tool {
namespace {

using nlohmann::json;

/// The lines that replace one ODOMETRY line; `index` counts them, 50 a second.
using Fault = std::function<std::vector<json>(json line, int index)>;

/// Result of a replay of the drive.
struct Replayed {
  std::vector<std::string> poses;  ///< their lines
  std::map<std::string, int> states;
  std::size_t wrong = 0;  ///< fix or tracking, off by over 10 cm or 5 degrees
  double worst_fix_m = 0;
  double worst_m = 0;
  json odometry;  ///< of the last STATUS

  int counter(const char* name) const { return odometry["counters"][name].get<int>(); }
  int count(const char* state) const {
    const auto found = states.find(state);
    return found == states.end() ? 0 : found->second;
  }
};

class OdometryFaults : public testing::Test {
 protected:
  /// 20 s around a circuit of a flat; the lidar is covered for two of them.
  OdometryFaults() {
    const CommandRun run({"simulate", "--map", map_, "--scenario", "circuit-1", "--scans", "150",
                          "--drive-speed", "0.4", "--odometry", "--covered", "15,17", "-o",
                          recording_, "--truth", truth_});
    if (run.exit_code != 0) throw std::runtime_error(run.err);
  }

  Replayed replay(const Fault& fault, const std::vector<std::string>& settings = {}) const {
    const std::string faulty = folder_ / "faulty.ndjson";
    {
      std::ifstream from(recording_);
      std::ofstream to(faulty);
      int index = 0;
      for (std::string text; std::getline(from, text);) {
        if (text.find("ODOMETRY") == std::string::npos) {
          to << text << '\n';
        } else {
          for (const json& line : fault(json::parse(text), index)) to << line.dump() << '\n';
          ++index;
        }
      }
    }
    std::vector<std::string> words = {"replay", faulty,  "--map",
                                      map_,     "--set", "/odometry/source=socket"};
    for (const std::string& setting : settings) words.insert(words.end(), {"--set", setting});
    const CommandRun run(words);
    EXPECT_EQ(run.exit_code, 0) << run.err;
    return judge(run.out);
  }

  Replayed judge(const std::string& messages) const {
    const Truth truth = Truth::load(truth_);
    Replayed replayed;
    std::istringstream lines(messages);
    for (std::string text; std::getline(lines, text);) {
      const json line = json::parse(text);
      if (line["class"] == "STATUS") replayed.odometry = line.value("odometry", json());
      if (line["class"] != "POSE") continue;
      replayed.poses.push_back(text);
      ++replayed.states[line["state"]];
      const auto at = truth.at(core::from_seconds(line["t"]));
      if (!line.contains("x") || !at) continue;
      const double off_m = (core::Vec2(line["x"], line["y"]) - at->translation()).norm();
      const double off_rad = std::abs(core::angle_between(at->theta_rad, line["theta"]));
      if (off_m > 0.1 || off_rad > core::radians(5)) ++replayed.wrong;
      replayed.worst_m = std::max(replayed.worst_m, off_m);
      if (line["state"] == "fix") replayed.worst_fix_m = std::max(replayed.worst_fix_m, off_m);
    }
    return replayed;
  }

  /// As many correct fixes as without a fault, and predictions under cover.
  static void expect_unharmed(const Replayed& replayed, int fewest_fixes = 130) {
    expect_right(replayed);
    EXPECT_GE(replayed.count("fix"), fewest_fixes);
    EXPECT_GE(replayed.count("predicted"), 12);
    EXPECT_LT(replayed.worst_m, 0.03);
    EXPECT_EQ(replayed.odometry["state"], "running");
  }
  /// No wrong pose; there may be fewer. A scan in a motion that no wheel tells of may be taken for
  /// one of a map that is off by centimetres.
  static void expect_right(const Replayed& replayed) {
    EXPECT_EQ(replayed.wrong, 0U);
    EXPECT_EQ(replayed.poses.size(), 150U);
    EXPECT_GE(replayed.count("fix"), 120);
  }

  test::TemporaryFolder folder_;
  const std::string map_ = CORNERD_SOURCE_DIR "/config/maps/flat-7.json";
  const std::string recording_ = folder_ / "drive.ndjson";
  const std::string truth_ = folder_ / "truth.ndjson";
};

/// Both counts offset by `offset`, wrapping.
Fault wrapped(std::int64_t offset, std::int64_t counter_max) {
  return [=](json line, int) -> std::vector<json> {
    for (const char* wheel : {"left", "right"}) {
      line[wheel] = (line[wheel].get<std::int64_t>() + offset) & counter_max;
    }
    return {std::move(line)};
  };
}

/// No line from reading `first` to before `last`.
Fault absent(int first, int last) {
  return [=](json line, int index) -> std::vector<json> {
    if (index >= first && index < last) return {};
    return {std::move(line)};
  };
}

/// The line lacks that field from reading `first` on.
Fault without(const char* field, int first) {
  return [=](json line, int index) -> std::vector<json> {
    if (index >= first) line.erase(field);
    return {std::move(line)};
  };
}

/// The field keeps its value from reading `first` on.
Fault frozen(std::vector<const char*> fields, int first) {
  return [=, held = json()](json line, int index) mutable -> std::vector<json> {
    if (index == first) held = line;
    for (const char* field : fields) {
      if (index > first) line[field] = held[field];
    }
    return {std::move(line)};
  };
}

/// After each tenth line the same line at another time.
Fault another_time_beside(double by_s) {
  return [=](json line, int index) -> std::vector<json> {
    json other = line;
    other["t"] = line["t"].get<double>() + by_s;
    if (index % 10 != 0) return {std::move(line)};
    return {std::move(line), std::move(other)};
  };
}

const Fault kNone = [](json line, int) { return std::vector<json>{std::move(line)}; };

TEST_F(OdometryFaults, NoFault_IsTheReference) {
  const Replayed clean = replay(kNone);
  expect_unharmed(clean);
  for (const char* counter : {"past", "future", "jumps", "invalid_rates", "stuck", "gaps"}) {
    EXPECT_EQ(clean.counter(counter), 0) << counter;
  }
}

TEST_F(OdometryFaults, CountsWrap_PosesAreUnchanged) {
  const Replayed clean = replay(kNone);
  EXPECT_EQ(replay(wrapped(65000, 0xFFFF), {"/advanced/odometry/counter_max=65535"}).poses,
            clean.poses);
  EXPECT_EQ(replay(wrapped(0xFFFFF000, 0xFFFFFFFF)).poses, clean.poses);
}

TEST_F(OdometryFaults, CountsJumpOnce_OnlyThatReadingIsRejected) {
  for (const int reading : {300, 800}) {  // lidar uncovered, covered
    for (const int by : {30464, -30464, 5198147}) {
      const Replayed replayed = replay([=](json line, int index) -> std::vector<json> {
        if (index == reading) line["left"] = (line["left"].get<std::int64_t>() + by) & 0xFFFFFFFF;
        return {std::move(line)};
      });
      expect_unharmed(replayed);
      EXPECT_EQ(replayed.counter("jumps"), 1) << reading << ' ' << by;
    }
  }
}

TEST_F(OdometryFaults, ControllerRestarts_CountingContinues) {
  for (const int reading : {300, 800}) {
    const Replayed replayed =
        replay([=, at = json()](json line, int index) mutable -> std::vector<json> {
          if (index == reading) at = line;
          for (const char* wheel : {"left", "right"}) {
            if (index < reading) continue;
            line[wheel] =
                (line[wheel].get<std::int64_t>() - at[wheel].get<std::int64_t>()) & 0xFFFFFFFF;
          }
          return {std::move(line)};
        });
    expect_unharmed(replayed);
    EXPECT_EQ(replayed.counter("restarts"), 1) << reading;
  }
}

TEST_F(OdometryFaults, RatesInvalid_OnlyTheyAreRejected) {
  for (const double rate_rad_s : {5198147.0, -5198147.0, 99.0}) {
    const Replayed replayed = replay([=](json line, int index) -> std::vector<json> {
      if (index % 10 == 0) line["gyro"] = rate_rad_s;
      return {std::move(line)};
    });
    expect_unharmed(replayed);
    // A reading with an invalid rate alone is not counted as a reading.
    EXPECT_EQ(replayed.counter("invalid_rates") + 1030 - replayed.counter("readings"), 103);
  }
}

TEST_F(OdometryFaults, ReadingsAbsent_GapIsCounted) {
  expect_unharmed(replay(absent(250, 400)));
  const Replayed under_cover = replay(absent(725, 850));  // lidar covered, uncovered
  expect_right(under_cover);
  EXPECT_GE(under_cover.count("lost"), 12);
}

TEST_F(OdometryFaults, OneSensorAbsent_OthersAreUsed) {
  expect_unharmed(replay(without("gyro", 0)));
  expect_unharmed(replay(without("gyro", 400)));
  for (const int first : {0, 400}) {
    const Replayed one_wheel = replay(without("left", first));
    expect_right(one_wheel);
    EXPECT_EQ(one_wheel.count("predicted"), 0) << first;
    EXPECT_EQ(one_wheel.odometry["state"], "absent") << first;
  }
}

TEST_F(OdometryFaults, GyroStuck_IsRejected) {
  for (const int first : {100, 400, 600}) {
    const Replayed replayed = replay(frozen({"gyro"}, first));
    expect_unharmed(replayed, 134);  // one fix fewer than with the others
    EXPECT_GT(replayed.counter("stuck"), 200) << first;
  }
}

TEST_F(OdometryFaults, WheelsStuck_AreUnhealthy) {
  for (const int first : {100, 400, 600}) {
    for (const auto& wheels : {std::vector{"left"}, std::vector{"left", "right"}}) {
      const Replayed replayed = replay(frozen(wheels, first));
      expect_right(replayed);
      EXPECT_EQ(replayed.odometry["state"], "unhealthy") << first;
    }
  }
}

TEST_F(OdometryFaults, PastReadingsAmongValidOnes_PosesAreUnchanged) {
  const Replayed clean = replay(kNone);
  for (const double by_s : {-0.05, -0.3}) {
    const Replayed replayed = replay(another_time_beside(by_s));
    EXPECT_EQ(replayed.poses, clean.poses) << by_s;
    EXPECT_NEAR(replayed.counter("past"), 103, 2) << by_s;
  }
}

TEST_F(OdometryFaults, FutureReadingsAmongValidOnes_PosesAreUnchanged) {
  for (const double by_s : {0.3, 1.5, 3.0, 3600.0}) {
    const Replayed replayed = replay(another_time_beside(by_s));
    expect_unharmed(replayed);
    EXPECT_GE(replayed.counter("future"), 95) << by_s;
  }
}

TEST_F(OdometryFaults, ClientClockFarOff_LidarAloneLocalizes) {
  const Replayed replayed = replay([](json line, int) -> std::vector<json> {
    line["t"] = line["t"].get<double>() + 3600;
    return {std::move(line)};
  });
  expect_right(replayed);
  EXPECT_EQ(replayed.count("predicted"), 0);
  EXPECT_EQ(replayed.odometry["state"], "absent");
  EXPECT_GT(replayed.counter("future"), 1000);
}

}  // namespace
}  // namespace cornerd::tool
