// SPDX-License-Identifier: MIT
#include "daemon/lidar_memory.hpp"

#include <gtest/gtest.h>
#include <stdlib.h>

#include <filesystem>
#include <fstream>

#include "tests/temporary_folder.hpp"

namespace cornerd::daemon {
namespace {

constexpr core::LearnedBias kLearned{
    {0.0098, 0.0051, 0.0036, -0.0034}, {4e-4, 5e-4, 2e-4, 2e-4}, 412};

class LidarMemoryTest : public ::testing::Test {
 protected:
  LidarMemory memory(const core::SensorBias& configured = {}) const { return {file_, configured}; }
  auto written() const { return std::filesystem::last_write_time(file_); }
  void age() const { std::filesystem::last_write_time(file_, written() - std::chrono::hours(1)); }

  test::TemporaryFolder folder_;
  std::filesystem::path file_ = folder_ / "lidar.json";
};

TEST_F(LidarMemoryTest, WhatWasKept_IsThereForTheNextRun) {
  LidarMemory first = memory();
  EXPECT_FALSE(first.recall());
  EXPECT_TRUE(first.recognise("A1"));
  first.keep(kLearned);
  LidarMemory second = memory();
  const auto recalled = second.recall();
  ASSERT_TRUE(recalled);
  EXPECT_EQ(recalled->bias, kLearned.bias);
  EXPECT_EQ(recalled->turns, kLearned.turns);
  EXPECT_TRUE(second.recognise(""));  // not identified yet
  EXPECT_TRUE(second.recognise("A1"));
}

TEST_F(LidarMemoryTest, AnotherDevice_KnowsNothingAndOverwritesOnlyWithItsOwn) {
  memory().keep(kLearned);
  LidarMemory first = memory();
  EXPECT_TRUE(first.recall());
  EXPECT_TRUE(first.recognise("A1"));  // kept without a number: whoever says one first has it
  EXPECT_FALSE(first.recognise("B2"));
  EXPECT_TRUE(first.recognise("B2"));
  age();
  const auto before = written();
  first.keep(kLearned);  // of a turn that was under way
  EXPECT_EQ(written(), before);
  first.keep({});
  core::LearnedBias fresh = kLearned;
  fresh.turns = 25;
  first.keep(fresh);
  EXPECT_NE(written(), before);
  LidarMemory third = memory();
  ASSERT_TRUE(third.recall());
  EXPECT_FALSE(third.recognise("A1"));
}

TEST_F(LidarMemoryTest, NothingNew_IsNotWritten) {
  LidarMemory keeper = memory();
  keeper.keep(kLearned);
  age();
  const auto before = written();
  core::LearnedBias hardly = kLearned;
  hardly.bias.range_offset_m += 0.4 * hardly.sigma.range_offset_m;
  hardly.turns = 500;
  keeper.keep(hardly);
  EXPECT_EQ(written(), before);
  hardly.bias.range_offset_m += 0.2 * hardly.sigma.range_offset_m;
  keeper.keep(hardly);
  EXPECT_NE(written(), before);
}

TEST_F(LidarMemoryTest, FewTurns_AreNotKept) {
  core::LearnedBias few = kLearned;
  few.turns = 5;
  memory().keep(few);
  EXPECT_FALSE(std::filesystem::exists(file_));
}

TEST_F(LidarMemoryTest, UnderOtherSettings_IsNotUsed) {
  memory().keep(kLearned);
  core::SensorBias configured;
  configured.range_scale = 0.01;
  EXPECT_FALSE(memory(configured).recall());
  EXPECT_TRUE(memory().recall());
}

TEST_F(LidarMemoryTest, SettingsThatChange_AreLearntUnderAnew) {
  LidarMemory keeper = memory();
  keeper.keep(kLearned);
  core::SensorBias configured;
  configured.range_scale = 0.01;
  keeper.reconfigure(configured);
  keeper.keep(kLearned);  // of a turn that was under way
  EXPECT_TRUE(memory().recall());
  keeper.keep({});
  keeper.keep(kLearned);
  EXPECT_FALSE(memory().recall());
  EXPECT_TRUE(memory(configured).recall());
}

TEST_F(LidarMemoryTest, FileThatIsDamaged_IsNotUsedAndReplaced) {
  std::ofstream(file_) << "{\"format\": \"corn";
  LidarMemory keeper = memory();
  EXPECT_FALSE(keeper.recall());
  keeper.keep(kLearned);
  EXPECT_TRUE(memory().recall());
}

TEST_F(LidarMemoryTest, FolderThatIsNotThere_CostsNothing) {
  LidarMemory keeper(folder_ / "absent" / "lidar.json", {});
  keeper.keep(kLearned);
  keeper.keep(kLearned);
  EXPECT_FALSE(keeper.recall());
}

TEST(LearnedFile, IsWhereTheSettingsOrTheServiceManagerSay) {
  settings::LidarConfig config;
  ::unsetenv("STATE_DIRECTORY");
  EXPECT_TRUE(learned_file(config).empty());
  ::setenv("STATE_DIRECTORY", "/var/lib/cornerd", 1);
  EXPECT_EQ(learned_file(config), "/var/lib/cornerd/lidar.json");
  config.learned_file = "/data/lidar.json";
  EXPECT_EQ(learned_file(config), "/data/lidar.json");
  config.learn_bias = false;
  EXPECT_TRUE(learned_file(config).empty());
  config.learn_bias = true;
  config.driver = settings::DriverKind::kReplay;
  EXPECT_TRUE(learned_file(config).empty());
  ::unsetenv("STATE_DIRECTORY");
}

}  // namespace
}  // namespace cornerd::daemon
