// SPDX-License-Identifier: MIT
#include "daemon/learned_walls_file.hpp"

#include <gtest/gtest.h>
#include <stdlib.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <string>

#include "captured_log.hpp"
#include "tests/temporary_folder.hpp"

namespace cornerd::daemon {
namespace {

const core::LearnedWalls kLearned{{{3, 0.012, 0.01}, {0, -0.02, 0.02}}, {1e-4, 5e-5, 4e-4}};

TEST(LearnedWallsFile, Stored_LoadedForThatMapAlone) {
  test::TemporaryFolder folder;
  LearnedWallsFile first(folder.path());
  EXPECT_TRUE(first.load("abc", 27).offsets.empty());
  first.update("abc", kLearned);
  LearnedWallsFile second(folder.path());
  EXPECT_TRUE(second.load("abd", 27).offsets.empty());
  EXPECT_EQ(second.load("abc", 27).covariance_m2, kLearned.covariance_m2);
}

TEST(LearnedWallsFile, WallsThatTheMapLacks_NotUsed) {
  test::TemporaryFolder folder;
  LearnedWallsFile file(folder.path());
  file.load("abc", 27);
  file.update("abc", kLearned);
  EXPECT_TRUE(LearnedWallsFile(folder.path()).load("abc", 1).offsets.empty());
}

TEST(LearnedWallsFile, InsignificantChange_NotWritten) {
  test::TemporaryFolder folder;
  LearnedWallsFile file(folder.path());
  file.load("abc", 27);
  file.update("abc", kLearned);
  core::LearnedWalls walls = kLearned;
  walls.offsets[0].offset_m += 0.001;
  file.update("abc", walls);
  EXPECT_EQ(LearnedWallsFile(folder.path()).load("abc", 27).offsets[0].offset_m, 0.012);
  walls.offsets[0].offset_m += 0.02;
  file.update("abc", walls);
  EXPECT_EQ(LearnedWallsFile(folder.path()).load("abc", 27).offsets[0].offset_m,
            walls.offsets[0].offset_m);
}

TEST(LearnedWallsFile, DamagedFile_NotUsed) {
  test::TemporaryFolder folder;
  std::ofstream(folder / "walls-abc.json") << "{";
  LearnedWallsFile file(folder.path());
  EXPECT_TRUE(file.load("abc", 27).offsets.empty());
}

TEST(LearnedWallsFile, Folder_ConfiguredOrTheServicesOrNone) {
  settings::Config config;
  ::unsetenv("STATE_DIRECTORY");
  EXPECT_TRUE(learned_walls_folder(config).empty());
  ::setenv("STATE_DIRECTORY", "/var/lib/cornerd", 1);
  EXPECT_EQ(learned_walls_folder(config), "/var/lib/cornerd");
  config.walls_folder = "/data";
  EXPECT_EQ(learned_walls_folder(config), "/data");
  config.lidar.driver = settings::DriverKind::kReplay;
  EXPECT_TRUE(learned_walls_folder(config).empty());
  ::unsetenv("STATE_DIRECTORY");
}

TEST(LearnedWallsFile, LoopOfLinks_SaidOnce) {
  test::TemporaryFolder folder;
  const CapturedLog log;
  std::filesystem::create_symlink("loop", folder / "loop");
  LearnedWallsFile file(folder / "loop");
  file.load("abc", 27);
  EXPECT_NE(file.problem().find("is not used: "), std::string::npos) << file.problem();
  core::LearnedWalls walls = kLearned;
  file.update("abc", walls);
  walls.offsets[0].offset_m += 1;
  file.update("abc", walls);
  EXPECT_NE(file.problem().find("set another /advanced/localizer/walls_folder"), std::string::npos);
  const std::string text = log.text();
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 2) << text;
}

TEST(LearnedWallsFile, FolderThatAppears_MendsIt) {
  test::TemporaryFolder folder;
  LearnedWallsFile file(folder / "later");
  file.load("abc", 27);
  EXPECT_EQ(file.problem(), "") << "nothing is stored yet";
  file.update("abc", kLearned);
  EXPECT_NE(file.problem(), "");
  std::filesystem::create_directory(folder / "later");
  file.update("abc", kLearned);
  EXPECT_EQ(file.problem(), "");
}

}  // namespace
}  // namespace cornerd::daemon
