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

const WallReport kLearned{"abc", {{{3, 0.012, 0.01}, {0, -0.02, 0.02}}, {1e-4, 5e-5, 4e-4}}, {}};

/// Has stored kLearned.
LearnedWallsFile file_with_walls(const test::TemporaryFolder& folder) {
  LearnedWallsFile file(folder.path());
  file.load("abc", 27);
  file.update(kLearned);
  return file;
}

TEST(LearnedWallsFile, Stored_LoadedForThatMapAlone) {
  test::TemporaryFolder folder;
  LearnedWallsFile first(folder.path());
  EXPECT_TRUE(first.load("abc", 27).walls.offsets.empty());
  first.update(kLearned);
  LearnedWallsFile second(folder.path());
  EXPECT_TRUE(second.load("abd", 27).walls.offsets.empty());
  EXPECT_EQ(second.load("abc", 27).walls.covariance_m2, kLearned.walls.covariance_m2);
}

TEST(LearnedWallsFile, WallsThatTheMapLacks_NotUsed) {
  test::TemporaryFolder folder;
  file_with_walls(folder);
  EXPECT_TRUE(LearnedWallsFile(folder.path()).load("abc", 1).walls.offsets.empty());
}

TEST(LearnedWallsFile, InsignificantChange_NotWritten) {
  test::TemporaryFolder folder;
  LearnedWallsFile file = file_with_walls(folder);
  WallReport learned = kLearned;
  learned.walls.offsets[0].offset_m += 0.001;
  file.update(learned);
  EXPECT_EQ(LearnedWallsFile(folder.path()).load("abc", 27).walls.offsets[0].offset_m, 0.012);
  learned.walls.offsets[0].offset_m += 0.02;
  file.update(learned);
  EXPECT_EQ(LearnedWallsFile(folder.path()).load("abc", 27).walls.offsets[0].offset_m,
            learned.walls.offsets[0].offset_m);
}

TEST(LearnedWallsFile, ChangeOfTheMap_WrittenAndKept) {
  test::TemporaryFolder folder;
  LearnedWallsFile file = file_with_walls(folder);
  WallReport learned = kLearned;
  learned.changes = {{core::MapChange::Kind::kWallGone, 12, core::Vec2::Zero()}};
  file.update(learned);
  EXPECT_EQ(LearnedWallsFile(folder.path()).load("abc", 27).changes, learned.changes);
}

TEST(LearnedWallsFile, LearningSwitchedOff_StoredStays) {
  test::TemporaryFolder folder;
  LearnedWallsFile file = file_with_walls(folder);
  file.update({"abc", {}, {}});
  EXPECT_FALSE(LearnedWallsFile(folder.path()).load("abc", 27).walls.offsets.empty());
}

TEST(LearnedWallsFile, DamagedFile_NotUsed) {
  test::TemporaryFolder folder;
  std::ofstream(folder / "walls-abc.json") << "{";
  LearnedWallsFile file(folder.path());
  EXPECT_TRUE(file.load("abc", 27).walls.offsets.empty());
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
  WallReport learned = kLearned;
  file.update(learned);
  learned.walls.offsets[0].offset_m += 1;
  file.update(learned);
  EXPECT_NE(file.problem().find("set another /advanced/localizer/walls_folder"), std::string::npos);
  const std::string text = log.text();
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 2) << text;
}

TEST(LearnedWallsFile, FolderThatAppears_MendsIt) {
  test::TemporaryFolder folder;
  LearnedWallsFile file(folder / "later");
  file.load("abc", 27);
  EXPECT_EQ(file.problem(), "") << "nothing is stored yet";
  file.update(kLearned);
  EXPECT_NE(file.problem(), "");
  std::filesystem::create_directory(folder / "later");
  file.update(kLearned);
  EXPECT_EQ(file.problem(), "");
}

}  // namespace
}  // namespace cornerd::daemon
