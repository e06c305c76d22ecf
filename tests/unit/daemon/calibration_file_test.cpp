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

constexpr core::EstimatedBias kEstimated{
    {0.0098, 0.0051, 0.0036, -0.0034}, {4e-4, 5e-4, 2e-4, 2e-4}, 412};

class CalibrationFileTest : public ::testing::Test {
 protected:
  CalibrationFile open_file(const core::SensorBias& configured = {}) const {
    return {file_, configured};
  }
  test::TemporaryFolder folder_;
  std::filesystem::path file_ = folder_ / "lidar.json";
};

TEST_F(CalibrationFileTest, StoredBias_LoadedByNextRun) {
  CalibrationFile first = open_file();
  EXPECT_EQ(first.estimate().scans, 0u);
  EXPECT_TRUE(first.identify("A1"));
  first.update(kEstimated);
  CalibrationFile second = open_file();
  EXPECT_EQ(second.estimate().bias, kEstimated.bias);
  EXPECT_EQ(second.estimate().scans, kEstimated.scans);
  EXPECT_TRUE(second.identify(""));  // the device has not reported its number yet
  EXPECT_TRUE(second.identify("A1"));
  second.update({});  // before the first scan
  EXPECT_EQ(second.estimate().scans, kEstimated.scans);
}

TEST_F(CalibrationFileTest, AnotherDevice_ForgetsEstimateAndKeepsFileUntilItHasItsOwn) {
  open_file().update(kEstimated);
  CalibrationFile first = open_file();
  EXPECT_TRUE(first.identify("A1"));  // stored without a number, so any number matches
  EXPECT_FALSE(first.identify("B2"));
  EXPECT_TRUE(first.identify("B2"));
  EXPECT_EQ(first.estimate().scans, 0u);
  EXPECT_EQ(open_file().estimate().scans, kEstimated.scans);
  core::EstimatedBias fresh = kEstimated;
  fresh.scans = 25;
  first.update(fresh);
  CalibrationFile third = open_file();
  EXPECT_EQ(third.estimate().scans, 25u);
  EXPECT_FALSE(third.identify("A1"));
}

TEST_F(CalibrationFileTest, InsignificantChange_NotWritten) {
  CalibrationFile file = open_file();
  file.update(kEstimated);
  core::EstimatedBias slightly_changed = kEstimated;
  slightly_changed.bias.range_offset_m += 0.4 * slightly_changed.sigma.range_offset_m;
  slightly_changed.scans = 500;
  file.update(slightly_changed);
  EXPECT_EQ(file.estimate().scans, 500u);
  EXPECT_EQ(open_file().estimate().scans, kEstimated.scans);
  slightly_changed.bias.range_offset_m += 0.2 * slightly_changed.sigma.range_offset_m;
  slightly_changed.scans = 501;
  file.update(slightly_changed);
  EXPECT_EQ(open_file().estimate().scans, 501u);
}

TEST_F(CalibrationFileTest, FewScans_NotStored) {
  core::EstimatedBias few = kEstimated;
  few.scans = 5;
  open_file().update(few);
  EXPECT_FALSE(std::filesystem::exists(file_));
}

TEST_F(CalibrationFileTest, OtherConfiguredBias_EstimatedAnew) {
  core::SensorBias configured;
  configured.range_scale = 0.01;
  CalibrationFile file = open_file();
  file.update(kEstimated);
  EXPECT_EQ(open_file(configured).estimate().scans, 0u);
  EXPECT_TRUE(file.reconfigure({}));
  EXPECT_FALSE(file.reconfigure(configured));
  EXPECT_EQ(file.estimate().scans, 0u);
  file.update(kEstimated);
  EXPECT_EQ(open_file().estimate().scans, 0u);
  EXPECT_EQ(open_file(configured).estimate().scans, kEstimated.scans);
}

TEST_F(CalibrationFileTest, TruncatedFile_NotUsedAndReplaced) {
  open_file().update(kEstimated);
  for (const std::uintmax_t length : {200, 10, 1}) {
    std::filesystem::resize_file(file_, length);
    CalibrationFile file = open_file();
    EXPECT_EQ(file.estimate().scans, 0u) << length;
    file.update(kEstimated);
    EXPECT_EQ(open_file().estimate().scans, kEstimated.scans) << length;
  }
}

TEST_F(CalibrationFileTest, EmptyOrZeroFile_Replaced) {
  for (const std::string& left : {std::string(), std::string(400, '\0')}) {
    std::ofstream(file_) << left;
    CalibrationFile file = open_file();
    EXPECT_EQ(file.estimate().scans, 0u) << left.size();
    file.update(kEstimated);
    EXPECT_EQ(open_file().estimate().scans, kEstimated.scans) << left.size();
  }
}

TEST_F(CalibrationFileTest, NotJson_LeftAlone) {
  std::ofstream(file_) << "precious";
  open_file().update(kEstimated);
  std::string text;
  std::ifstream(file_) >> text;
  EXPECT_EQ(text, "precious");
}

TEST_F(CalibrationFileTest, JsonOfAnotherFormat_LeftAlone) {
  const std::string map = R"({"format": "cornerd-map", "version": 1, "walls": []})";
  std::ofstream(file_) << map;
  CalibrationFile file = open_file();
  file.update(kEstimated);
  std::string text;
  std::getline(std::ifstream(file_) >> std::ws, text);
  EXPECT_EQ(text, map);
  EXPECT_EQ(file.estimate().scans, kEstimated.scans);  // kept in memory for a reload
}

TEST_F(CalibrationFileTest, NotRegularFile_LeftAloneWithoutBlocking) {
  ASSERT_EQ(::mkfifo(file_.c_str(), 0600), 0);
  open_file().update(kEstimated);
  EXPECT_TRUE(std::filesystem::is_fifo(file_));
  std::filesystem::remove(file_);
  std::filesystem::create_directory(file_);
  open_file().update(kEstimated);
  EXPECT_TRUE(std::filesystem::is_directory(file_));
}

TEST_F(CalibrationFileTest, SymbolicLink_TargetReplaced) {
  core::EstimatedBias before = kEstimated;
  before.scans = 30;
  CalibrationFile(folder_ / "elsewhere.json", {}).update(before);
  std::filesystem::create_symlink(folder_ / "elsewhere.json", file_);
  core::EstimatedBias better = kEstimated;
  better.sigma.range_scale *= 0.5;
  open_file().update(better);
  EXPECT_TRUE(std::filesystem::is_symlink(file_));
  EXPECT_EQ(open_file().estimate().scans, kEstimated.scans);
}

TEST_F(CalibrationFileTest, FolderCreatedLater_FileWritten) {
  CalibrationFile file(folder_ / "later" / "lidar.json", {});
  file.update(kEstimated);
  std::filesystem::create_directory(folder_ / "later");
  core::EstimatedBias more = kEstimated;
  more.scans = 413;
  file.update(more);
  EXPECT_EQ(CalibrationFile(folder_ / "later" / "lidar.json", {}).estimate().scans, 413u);
}

TEST(CalibrationFilePath, ConfiguredPathThenStateDirectory_Used) {
  settings::LidarConfig config;
  ::unsetenv("STATE_DIRECTORY");
  EXPECT_TRUE(calibration_file_path(config).empty());
  ::setenv("STATE_DIRECTORY", "/var/lib/cornerd", 1);
  EXPECT_EQ(calibration_file_path(config), "/var/lib/cornerd/lidar.json");
  config.calibration_file = "/data/lidar.json";
  EXPECT_EQ(calibration_file_path(config), "/data/lidar.json");
  config.driver = settings::DriverKind::kReplay;
  EXPECT_TRUE(calibration_file_path(config).empty());
  ::unsetenv("STATE_DIRECTORY");
}

}  // namespace
}  // namespace cornerd::daemon
