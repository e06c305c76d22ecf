// SPDX-License-Identifier: MIT
#include "daemon/lidar_memory.hpp"

#include <gtest/gtest.h>
#include <stdlib.h>
#include <sys/stat.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "tests/temporary_folder.hpp"

namespace cornerd::daemon {
namespace {

constexpr core::LearnedBias kLearned{
    {0.0098, 0.0051, 0.0036, -0.0034}, {4e-4, 5e-4, 2e-4, 2e-4}, 412};

class LidarMemoryTest : public ::testing::Test {
 protected:
  LidarMemory memory(const core::SensorBias& configured = {}) const { return {file_, configured}; }
  test::TemporaryFolder folder_;
  std::filesystem::path file_ = folder_ / "lidar.json";
};

TEST_F(LidarMemoryTest, WhatWasKept_IsThereForTheNextRun) {
  LidarMemory first = memory();
  EXPECT_EQ(first.known().scans, 0u);
  EXPECT_TRUE(first.recognise("A1"));
  first.keep(kLearned);
  LidarMemory second = memory();
  EXPECT_EQ(second.known().bias, kLearned.bias);
  EXPECT_EQ(second.known().scans, kLearned.scans);
  EXPECT_TRUE(second.recognise(""));  // not identified yet
  EXPECT_TRUE(second.recognise("A1"));
  second.keep({});  // before the first turn
  EXPECT_EQ(second.known().scans, kLearned.scans);
}

TEST_F(LidarMemoryTest, AnotherDevice_KnowsNothingAndOverwritesOnlyWithItsOwn) {
  memory().keep(kLearned);
  LidarMemory first = memory();
  EXPECT_TRUE(first.recognise("A1"));  // kept without a number: whoever says one first has it
  EXPECT_FALSE(first.recognise("B2"));
  EXPECT_TRUE(first.recognise("B2"));
  EXPECT_EQ(first.known().scans, 0u);
  EXPECT_EQ(memory().known().scans, kLearned.scans);
  core::LearnedBias fresh = kLearned;
  fresh.scans = 25;
  first.keep(fresh);
  LidarMemory third = memory();
  EXPECT_EQ(third.known().scans, 25u);
  EXPECT_FALSE(third.recognise("A1"));
}

TEST_F(LidarMemoryTest, NothingNew_IsNotWritten) {
  LidarMemory keeper = memory();
  keeper.keep(kLearned);
  core::LearnedBias hardly = kLearned;
  hardly.bias.range_offset_m += 0.4 * hardly.sigma.range_offset_m;
  hardly.scans = 500;
  keeper.keep(hardly);
  EXPECT_EQ(keeper.known().scans, 500u);
  EXPECT_EQ(memory().known().scans, kLearned.scans);
  hardly.bias.range_offset_m += 0.2 * hardly.sigma.range_offset_m;
  hardly.scans = 501;
  keeper.keep(hardly);
  EXPECT_EQ(memory().known().scans, 501u);
}

TEST_F(LidarMemoryTest, FewTurns_AreNotKept) {
  core::LearnedBias few = kLearned;
  few.scans = 5;
  memory().keep(few);
  EXPECT_FALSE(std::filesystem::exists(file_));
}

TEST_F(LidarMemoryTest, OtherSettings_AreLearntUnderAnew) {
  core::SensorBias configured;
  configured.range_scale = 0.01;
  LidarMemory keeper = memory();
  keeper.keep(kLearned);
  EXPECT_EQ(memory(configured).known().scans, 0u);
  EXPECT_TRUE(keeper.reconfigure({}));
  EXPECT_FALSE(keeper.reconfigure(configured));
  EXPECT_EQ(keeper.known().scans, 0u);
  keeper.keep(kLearned);
  EXPECT_EQ(memory().known().scans, 0u);
  EXPECT_EQ(memory(configured).known().scans, kLearned.scans);
}

TEST_F(LidarMemoryTest, FileThatWasCutShort_IsNotUsedAndReplaced) {
  memory().keep(kLearned);
  for (const std::uintmax_t length : {200, 10, 1}) {
    std::filesystem::resize_file(file_, length);
    LidarMemory keeper = memory();
    EXPECT_EQ(keeper.known().scans, 0u) << length;
    keeper.keep(kLearned);
    EXPECT_EQ(memory().known().scans, kLearned.scans) << length;
  }
}

TEST_F(LidarMemoryTest, FileThatAPowerCutEmptied_IsReplaced) {
  for (const std::string& left : {std::string(), std::string(400, '\0')}) {
    std::ofstream(file_) << left;
    LidarMemory keeper = memory();
    EXPECT_EQ(keeper.known().scans, 0u) << left.size();
    keeper.keep(kLearned);
    EXPECT_EQ(memory().known().scans, kLearned.scans) << left.size();
    EXPECT_FALSE(std::filesystem::exists(file_.string() + ".bad"));
  }
}

TEST_F(LidarMemoryTest, FileThatIsNoJson_IsSetAside) {
  std::ofstream(file_) << "precious";
  memory().keep(kLearned);
  EXPECT_EQ(memory().known().scans, kLearned.scans);
  std::string text;
  std::ifstream(file_.string() + ".bad") >> text;
  EXPECT_EQ(text, "precious");
}

TEST_F(LidarMemoryTest, FileOfAnotherKind_IsLeftAlone) {
  const std::string map = R"({"format": "cornerd-map", "version": 1, "walls": []})";
  std::ofstream(file_) << map;
  LidarMemory keeper = memory();
  keeper.keep(kLearned);
  std::string text;
  std::getline(std::ifstream(file_) >> std::ws, text);
  EXPECT_EQ(text, map);
  EXPECT_EQ(keeper.known().scans, kLearned.scans);  // for a reload
}

TEST_F(LidarMemoryTest, FileThatIsNone_IsLeftAloneWithoutAWait) {
  ASSERT_EQ(::mkfifo(file_.c_str(), 0600), 0);
  memory().keep(kLearned);
  EXPECT_TRUE(std::filesystem::is_fifo(file_));
  std::filesystem::remove(file_);
  std::filesystem::create_directory(file_);
  memory().keep(kLearned);
  EXPECT_TRUE(std::filesystem::is_directory(file_));
}

TEST_F(LidarMemoryTest, Link_IsFollowed) {
  core::LearnedBias before = kLearned;
  before.scans = 30;
  LidarMemory(folder_ / "elsewhere.json", {}).keep(before);
  std::filesystem::create_symlink(folder_ / "elsewhere.json", file_);
  core::LearnedBias better = kLearned;
  better.sigma.range_scale *= 0.5;
  memory().keep(better);
  EXPECT_TRUE(std::filesystem::is_symlink(file_));
  EXPECT_EQ(memory().known().scans, kLearned.scans);
}

TEST_F(LidarMemoryTest, FolderThatComesLater_IsWrittenInto) {
  LidarMemory keeper(folder_ / "later" / "lidar.json", {});
  keeper.keep(kLearned);
  std::filesystem::create_directory(folder_ / "later");
  core::LearnedBias more = kLearned;
  more.scans = 413;
  keeper.keep(more);
  EXPECT_EQ(LidarMemory(folder_ / "later" / "lidar.json", {}).known().scans, 413u);
}

TEST(LearnedFile, IsWhereTheSettingsOrTheServiceManagerSay) {
  settings::LidarConfig config;
  ::unsetenv("STATE_DIRECTORY");
  EXPECT_TRUE(calibration_file(config).empty());
  ::setenv("STATE_DIRECTORY", "/var/lib/cornerd", 1);
  EXPECT_EQ(calibration_file(config), "/var/lib/cornerd/lidar.json");
  config.calibration_file = "/data/lidar.json";
  EXPECT_EQ(calibration_file(config), "/data/lidar.json");
  config.driver = settings::DriverKind::kReplay;
  EXPECT_TRUE(calibration_file(config).empty());
  ::unsetenv("STATE_DIRECTORY");
}

}  // namespace
}  // namespace cornerd::daemon
