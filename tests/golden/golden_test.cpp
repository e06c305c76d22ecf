// SPDX-License-Identifier: MIT
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include "core/geometry/angle.hpp"
#include "core/pipeline.hpp"
#include "drivers/lidar_status.hpp"
#include "message/line_writer.hpp"
#include "settings/config.hpp"
#include "settings/map_file.hpp"
#include "tool/replay/playback.hpp"

namespace cornerd {
namespace {

const std::filesystem::path kFolder =
    std::filesystem::path(CORNERD_SOURCE_DIR) / "tests/golden/recordings";

struct Golden {
  const char* recording;
  const char* map;
  const char* config;
  bool independent;  ///< each scan is at another pose
};

void PrintTo(const Golden& golden, std::ostream* out) { *out << golden.recording; }

/// Rounded to a multiple of `step`; never -0.
std::string rounded(double value, double step, int decimals) {
  return fmt::format("{:.{}f}", std::round(value / step) * step + 0.0, decimals);
}

std::string scan_text(const core::ScanResult& result, const core::FloorPlan& plan) {
  const core::PoseEstimate& pose = result.pose;
  std::string text = fmt::format("{:3} {:9} corners {:2} ends and corners seen {:2}", pose.seq,
                                 message::to_string(pose.state), pose.corners,
                                 result.detection.breakpoints.size());
  const bool is_localized =
      pose.state != core::PoseState::kLost && pose.state != core::PoseState::kAmbiguous;
  if (is_localized) {
    text += fmt::format("  x {} y {} theta {}", rounded(pose.T_map_base.x_m, 0.001, 3),
                        rounded(pose.T_map_base.y_m, 0.001, 3),
                        rounded(core::degrees(pose.T_map_base.theta_rad), 0.1, 1));
  }
  if (pose.room) text += " " + plan.rooms[*pose.room].name;
  if (!pose.alternatives.empty()) text += fmt::format(" {} places", pose.alternatives.size());
  return text + "\n";
}

std::string replay_text(const Golden& golden) {
  const auto map =
      settings::load_map(std::filesystem::path(CORNERD_SOURCE_DIR) / "config/maps" / golden.map);
  const settings::Config config = settings::parse_config(golden.config, "", {}, false);
  core::Pipeline pipeline(map, config.localizer());
  std::string text;
  drivers::StreamCounters counters;
  tool::Playback playback(
      pipeline,
      [&](const core::Scan&, const core::ScanResult& result) {
        text += scan_text(result, map->plan());
      },
      [&](core::TimeNs, const drivers::StreamCounters& so_far) { counters = so_far; });
  playback.set_independent(golden.independent);
  playback.play(kFolder / golden.recording, {});
  for (const auto& [name, member] : drivers::kCounterNames) {
    text += fmt::format("{} {}\n", name, counters.*member);
  }
  return text;
}

class GoldenReplay : public testing::TestWithParam<Golden> {};

TEST_P(GoldenReplay, Poses_MatchTheCommittedText) {
  const std::string text = replay_text(GetParam());
  const std::filesystem::path file = kFolder / (std::string(GetParam().recording) + ".txt");
  if (std::getenv("CORNERD_UPDATE_GOLDEN") != nullptr) {
    std::ofstream(file) << text;
    return;
  }
  std::ostringstream expected;
  expected << std::ifstream(file).rdbuf();
  EXPECT_EQ(text, expected.str()) << "if intended, see tests/golden/README.md";
}

INSTANTIATE_TEST_SUITE_P(
    Recordings, GoldenReplay,
    testing::Values(Golden{"drive-express.bin", "krpai-2019-a.json", "{}", false},
                    Golden{"places-standard.bin", "krpai-2019-a.json", "{}", true},
                    Golden{"damaged-ultra.bin", "krpai-2019-a.json", "{}", true},
                    Golden{"flat-real.bin", "flat-7.json", "{}", true},
                    Golden{"covered-odometry.ndjson", "krpai-2019-a.json",
                           R"({ "odometry": { "source": "socket" } })", false}));

}  // namespace
}  // namespace cornerd
