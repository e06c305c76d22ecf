// SPDX-License-Identifier: MIT
// Drives of which one part begins elsewhere than the previous part ended must not be joined.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <utility>

#include "bench/simulated_drive.hpp"
#include "replay/simulator/motion.hpp"
#include "settings/map_file.hpp"
#include "survey/survey.hpp"
#include "survey/validity_checks.hpp"

namespace cornerd {
namespace {

/// Two minutes of the exploration of the flat.
survey::RecordedDrive exploration(bool has_odometry) {
  const auto map =
      settings::load_map(std::filesystem::path(CORNERD_SOURCE_DIR) / "config/maps/flat-7.json");
  bench::SimulatedDriveConfig config;
  config.has_odometry = has_odometry;
  config.scans = 876;
  return bench::simulate_drive(
             map, replay::drive_path(replay::find_scenario("exploration")->path, {}), config)
      .drive;
}

/// Appends scans [first, last) and their odometry to a drive, as if the robot had been carried from
/// its last pose to that of the first scan.
void append(const survey::RecordedDrive& from, std::size_t first, std::size_t last,
            survey::RecordedDrive& to) {
  core::TimeNs later_ns = 0;
  if (to.size() > 0) {
    // Without a pause: a rotation at its beginning would be extrapolated over it.
    later_ns = to.end_ns(to.size() - 1) + core::kNsPerSecond / 1000 - from.start_ns(first);
  }
  std::pair<std::int64_t, std::int64_t> counts;
  bool is_first = true;
  std::size_t done = first;
  core::Scan scan;
  const auto add_scans = [&](std::size_t until) {
    for (; done < std::min(until, last); ++done) {
      from.load(done, scan);
      scan.shift(later_ns);
      to.add(scan);
    }
  };
  for (const survey::RecordedDrive::Reading& recorded : from.readings()) {
    if (recorded.scan < first || recorded.scan >= last) continue;
    add_scans(recorded.scan);
    core::OdometryReading reading = recorded.reading;
    if (is_first && !to.readings().empty()) {
      const core::OdometryReading& before = to.readings().back().reading;
      counts = {*before.left - *reading.left, *before.right - *reading.right};
    }
    is_first = false;
    reading.t_ns += later_ns;
    *reading.left += counts.first;
    *reading.right += counts.second;
    if (reading.arrival_ns) *reading.arrival_ns += later_ns;
    to.add(reading);
  }
  add_scans(last);
}

enum class Verdict { kGood, kWarned, kRefused };

Verdict judged(const survey::RecordedDrive& drive) {
  try {
    const survey::SurveyResult result = survey::survey(drive, {});
    return survey::has_free_space_conflicts(result.free_space_conflicts) ? Verdict::kWarned
                                                                         : Verdict::kGood;
  } catch (const std::invalid_argument& refused) {
    EXPECT_NE(std::string(refused.what()).find("maps several places over each other"),
              std::string::npos);
    return Verdict::kRefused;
  }
}

struct Cut {
  std::size_t end = 0;
  std::size_t begin = 0;
  Verdict least = Verdict::kWarned;
};
class SurveyOfPartsThatDoNotJoin : public testing::TestWithParam<Cut> {};

TEST_P(SurveyOfPartsThatDoNotJoin, WithOdometry_GapIsReported) {
  const survey::RecordedDrive once = exploration(/*has_odometry=*/true);
  survey::RecordedDrive parts;
  append(once, 0, GetParam().end, parts);
  append(once, GetParam().begin, once.size(), parts);
  EXPECT_GE(judged(parts), GetParam().least);
}

// Once the same drive; once a robot carried to another room.
INSTANTIATE_TEST_SUITE_P(CutAt, SurveyOfPartsThatDoNotJoin,
                         testing::Values(Cut{876, 0, Verdict::kWarned},
                                         Cut{145, 365, Verdict::kRefused}));

TEST(SurveyOfPartsThatJoin, WithOdometry_MapIsComplete) {
  const survey::RecordedDrive once = exploration(/*has_odometry=*/true);
  survey::RecordedDrive parts;
  append(once, 0, 400, parts);
  append(once, 400, once.size(), parts);
  const survey::SurveyResult result = survey::survey(parts, {});
  EXPECT_EQ(result.free_space_conflicts.length_m, 0);
  EXPECT_EQ(result.plan.walls.size(), survey::survey(once, {}).plan.walls.size());
}

}  // namespace
}  // namespace cornerd
