// SPDX-License-Identifier: MIT
// A robot in the ROS map of its floor, of $CORNERD_RECORDINGS/olin, a recording by others that is
// not part of the project. Skipped without it.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "core/geometry/angle.hpp"
#include "tests/temporary_folder.hpp"
#include "tests/unit/tool/command_run.hpp"

namespace cornerd {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

TEST(RealFloor, EachScanAlone_IsNamedWhereItWasTaken) {
  const char* recordings = std::getenv("CORNERD_RECORDINGS");
  if (recordings == nullptr || !fs::exists(fs::path(recordings) / "olin")) {
    GTEST_SKIP() << "CORNERD_RECORDINGS names no folder with olin in it";
  }
  const fs::path folder = fs::path(recordings) / "olin";
  const test::TemporaryFolder made;
  const std::string scans = made / "scans.ndjson";
  const std::string map = made / "floor.json";
  const std::string unpack = "gzip -dc '" + (folder / "log.ndjson.gz").string() + "' >" + scans;
  ASSERT_EQ(std::system(unpack.c_str()), 0);
  const tool::CommandRun imported(
      {"map", "import", folder / "mac_1st_floor_final.yaml", "-o", map});
  ASSERT_EQ(imported.exit_code, 0) << imported.err;
  const tool::CommandRun replayed({"replay", scans, "--map", map, "--independent", "--classes",
                                   "POSE", "--set", "/odometry/source=none"});
  ASSERT_EQ(replayed.exit_code, 0) << replayed.err;

  std::ifstream truths(folder / "truth.ndjson");
  std::istringstream poses(replayed.out);
  int named = 0;
  int count = 0;
  std::string of_pose;
  for (std::string of_truth; std::getline(truths, of_truth); ++count) {
    ASSERT_TRUE(std::getline(poses, of_pose));
    const json truth = json::parse(of_truth);
    const json pose = json::parse(of_pose);
    if (!pose.contains("x")) continue;
    ++named;
    EXPECT_LT(std::hypot(pose["x"].get<double>() - truth["x"].get<double>(),
                         pose["y"].get<double>() - truth["y"].get<double>()),
              0.3)
        << of_pose;
    EXPECT_LT(std::abs(core::angle_between(truth["theta"], pose["theta"])), core::radians(10))
        << of_pose;
  }
  EXPECT_EQ(count, 357);
  // 95 % are wanted: 340.
  EXPECT_GE(named, 0.93 * count);
}

}  // namespace
}  // namespace cornerd
