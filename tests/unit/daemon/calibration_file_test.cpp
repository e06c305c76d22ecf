// SPDX-License-Identifier: MIT
#include "daemon/calibration_file.hpp"

#include <gtest/gtest.h>
#include <stdlib.h>
#include <sys/stat.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "tests/temporary_folder.hpp"

namespace cornerd::daemon {
namespace {

constexpr core::EstimatedBias kLearned{
    {0.0098, 0.0051, 0.0036, -0.0034}, {4e-4, 5e-4, 2e-4, 2e-4}, 412};

class LidarMemoryTest : public ::testing::Test {
 protected:
  CalibrationFile open_file(const core::SensorBias& configured = {}) const {
    return {file_, configured};
  }
  test::TemporaryFolder folder_;
  std::filesystem::path file_ = folder_ / "lidar.json";
};

TEST_F(LidarMemoryTest, WhatWasKept_IsThereForTheNextRun) {
  CalibrationFile first = open_file();
  EXPECT_EQ(first.estimate().scans, 0u);
  EXPECT_TRUE(first.identify("A1"));
  first.update(kLearned);
  CalibrationFile second = open_file();
  EXPECT_EQ(second.estimate().bias, kLearned.bias);
  EXPECT_EQ(second.estimate().scans, kLearned.scans);
  EXPECT_TRUE(second.identify(""));  // not identified yet
  EXPECT_TRUE(second.identify("A1"));
  second.update({});  // before the first turn
  EXPECT_EQ(second.estimate().scans, kLearned.scans);
}

TEST_F(LidarMemoryTest, AnotherDevice_KnowsNothingAndOverwritesOnlyWithItsOwn) {
  open_file().update(kLearned);
  CalibrationFile first = open_file();
  EXPECT_TRUE(first.identify("A1"));  // kept without a number: whoever says one first has it
  EXPECT_FALSE(first.identify("B2"));
  EXPECT_TRUE(first.identify("B2"));
  EXPECT_EQ(first.estimate().scans, 0u);
  EXPECT_EQ(open_file().estimate().scans, kLearned.scans);
  core::EstimatedBias fresh = kLearned;
  fresh.scans = 25;
  first.update(fresh);
  CalibrationFile third = open_file();
  EXPECT_EQ(third.estimate().scans, 25u);
  EXPECT_FALSE(third.identify("A1"));
}

TEST_F(LidarMemoryTest, NothingNew_IsNotWritten) {
  CalibrationFile file = open_file();
  file.update(kLearned);
  core::EstimatedBias hardly = kLearned;
  hardly.bias.range_offset_m += 0.4 * hardly.sigma.range_offset_m;
  hardly.scans = 500;
  file.update(hardly);
  EXPECT_EQ(file.estimate().scans, 500u);
  EXPECT_EQ(open_file().estimate().scans, kLearned.scans);
  hardly.bias.range_offset_m += 0.2 * hardly.sigma.range_offset_m;
  hardly.scans = 501;
  file.update(hardly);
  EXPECT_EQ(open_file().estimate().scans, 501u);
}

TEST_F(LidarMemoryTest, FewTurns_AreNotKept) {
  core::EstimatedBias few = kLearned;
  few.scans = 5;
  open_file().update(few);
  EXPECT_FALSE(std::filesystem::exists(file_));
}

TEST_F(LidarMemoryTest, OtherSettings_AreLearntUnderAnew) {
  core::SensorBias configured;
  configured.range_scale = 0.01;
  CalibrationFile file = open_file();
  file.update(kLearned);
  EXPECT_EQ(open_file(configured).estimate().scans, 0u);
  EXPECT_TRUE(file.reconfigure({}));
  EXPECT_FALSE(file.reconfigure(configured));
  EXPECT_EQ(file.estimate().scans, 0u);
  file.update(kLearned);
  EXPECT_EQ(open_file().estimate().scans, 0u);
  EXPECT_EQ(open_file(configured).estimate().scans, kLearned.scans);
}

TEST_F(LidarMemoryTest, FileThatWasCutShort_IsNotUsedAndReplaced) {
  open_file().update(kLearned);
  for (const std::uintmax_t length : {200, 10, 1}) {
    std::filesystem::resize_file(file_, length);
    CalibrationFile file = open_file();
    EXPECT_EQ(file.estimate().scans, 0u) << length;
    file.update(kLearned);
    EXPECT_EQ(open_file().estimate().scans, kLearned.scans) << length;
  }
}

TEST_F(LidarMemoryTest, FileThatAPowerCutEmptied_IsReplaced) {
  for (const std::string& left : {std::string(), std::string(400, '\0')}) {
    std::ofstream(file_) << left;
    CalibrationFile file = open_file();
    EXPECT_EQ(file.estimate().scans, 0u) << left.size();
    file.update(kLearned);
    EXPECT_EQ(open_file().estimate().scans, kLearned.scans) << left.size();
    EXPECT_FALSE(std::filesystem::exists(file_.string() + ".bad"));
  }
}

TEST_F(LidarMemoryTest, FileThatIsNoJson_IsSetAside) {
  std::ofstream(file_) << "precious";
  open_file().update(kLearned);
  EXPECT_EQ(open_file().estimate().scans, kLearned.scans);
  std::string text;
  std::ifstream(file_.string() + ".bad") >> text;
  EXPECT_EQ(text, "precious");
}

TEST_F(LidarMemoryTest, FileOfAnotherKind_IsLeftAlone) {
  const std::string map = R"({"format": "cornerd-map", "version": 1, "walls": []})";
  std::ofstream(file_) << map;
  CalibrationFile file = open_file();
  file.update(kLearned);
  std::string text;
  std::getline(std::ifstream(file_) >> std::ws, text);
  EXPECT_EQ(text, map);
  EXPECT_EQ(file.estimate().scans, kLearned.scans);  // for a reload
}

TEST_F(LidarMemoryTest, FileThatIsNone_IsLeftAloneWithoutAWait) {
  ASSERT_EQ(::mkfifo(file_.c_str(), 0600), 0);
  open_file().update(kLearned);
  EXPECT_TRUE(std::filesystem::is_fifo(file_));
  std::filesystem::remove(file_);
  std::filesystem::create_directory(file_);
  open_file().update(kLearned);
  EXPECT_TRUE(std::filesystem::is_directory(file_));
}

TEST_F(LidarMemoryTest, Link_IsFollowed) {
  core::EstimatedBias before = kLearned;
  before.scans = 30;
  CalibrationFile(folder_ / "elsewhere.json", {}).update(before);
  std::filesystem::create_symlink(folder_ / "elsewhere.json", file_);
  core::EstimatedBias better = kLearned;
  better.sigma.range_scale *= 0.5;
  open_file().update(better);
  EXPECT_TRUE(std::filesystem::is_symlink(file_));
  EXPECT_EQ(open_file().estimate().scans, kLearned.scans);
}

TEST_F(LidarMemoryTest, FolderThatComesLater_IsWrittenInto) {
  CalibrationFile file(folder_ / "later" / "lidar.json", {});
  file.update(kLearned);
  std::filesystem::create_directory(folder_ / "later");
  core::EstimatedBias more = kLearned;
  more.scans = 413;
  file.update(more);
  EXPECT_EQ(CalibrationFile(folder_ / "later" / "lidar.json", {}).estimate().scans, 413u);
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
