// SPDX-License-Identifier: MIT
#include "drivers/odometry/encoder.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "sysfs_tree.hpp"

namespace cornerd::drivers {
namespace {

using ::testing::HasSubstr;

constexpr const char* kName = "48304180.counter";

class EncoderTest : public ::testing::Test {
 protected:
  std::optional<std::int64_t> read_count(const std::string& text) {
    tree_.set_count(0, text);
    return encoder_.read();
  }
  std::string detail() const { return std::string(encoder_.status().detail.view()); }

  test::SysfsTree tree_;
  Encoder encoder_{tree_.root(), {.counter = kName}};
};

TEST_F(EncoderTest, Counter_IsFoundByItsName) {
  tree_.add_counter(0, "48300180.counter");
  tree_.add_counter(1, kName);
  tree_.set_count(0, "1");
  tree_.set_count(1, "42");
  encoder_.look();
  EXPECT_EQ(encoder_.read(), 42);
  EXPECT_EQ(encoder_.status().state, SensorState::kRunning);
}

TEST_F(EncoderTest, NoCounterOfThatName_IsAbsentAndTellsOfOthers) {
  encoder_.look();
  EXPECT_EQ(encoder_.status().state, SensorState::kAbsent);
  tree_.add_counter(0, "48302180.counter");
  encoder_.look();
  EXPECT_EQ(encoder_.read(), std::nullopt);
  EXPECT_EQ(encoder_.status().state, SensorState::kAbsent);
  EXPECT_THAT(detail(), HasSubstr("48302180.counter"));
}

TEST_F(EncoderTest, TwoOfOneName_AreNotGuessedBetween) {
  tree_.add_counter(0, kName);
  tree_.add_counter(1, kName);
  encoder_.look();
  EXPECT_EQ(encoder_.status().state, SensorState::kAbsent);
  EXPECT_THAT(detail(), HasSubstr("several"));
}

TEST_F(EncoderTest, CounterThatIsNotSetUp_IsDisabledUntilItIs) {
  tree_.add_counter(0, kName);
  for (const auto& [attribute, text, right] :
       {std::array{"enable", "0", "1"}, std::array{"function", "increase", "quadrature x4"},
        std::array{"ceiling", "0", "4294967295"}}) {
    tree_.set_of_count(0, attribute, text);
    encoder_.look();
    EXPECT_EQ(encoder_.status().state, SensorState::kDisabled) << attribute;
    EXPECT_THAT(detail(), HasSubstr(attribute));
    EXPECT_EQ(encoder_.read(), std::nullopt) << attribute;
    tree_.set_of_count(0, attribute, right);
    encoder_.look();
    EXPECT_TRUE(encoder_.read()) << attribute;
  }
}

TEST_F(EncoderTest, CountsOverTheCeiling_GoOn) {
  tree_.add_counter(0, kName);
  encoder_.look();
  EXPECT_EQ(read_count("4294967290"), 4294967290);
  EXPECT_EQ(read_count("4"), 4294967300);
  EXPECT_EQ(read_count("4294967295"), 4294967295);
  EXPECT_EQ(encoder_.wraps(), 2u);
}

TEST_F(EncoderTest, AnyCeiling_IsWrappedAt) {
  tree_.add_counter(0, kName);
  tree_.set_of_count(0, "ceiling", "999");
  encoder_.look();
  EXPECT_EQ(read_count("990"), 990);
  EXPECT_EQ(read_count("5"), 1005);
}

TEST_F(EncoderTest, CounterWithoutCeiling_DoesNotWrap) {
  tree_.add_counter(0, kName);
  tree_.remove(test::SysfsTree::counter(0) + "/count0/ceiling");
  encoder_.look();
  EXPECT_EQ(read_count("4294967295"), 4294967295);
  EXPECT_EQ(read_count("-5"), -5);
  EXPECT_EQ(encoder_.wraps(), 0u);
}

TEST_F(EncoderTest, ReversedOne_CountsBackwards) {
  tree_.add_counter(0, kName);
  Encoder reversed(tree_.root(), {.counter = kName, .reversed = true});
  reversed.look();
  tree_.set_count(0, "4294967290");
  EXPECT_EQ(reversed.read(), -4294967290);
  tree_.set_count(0, "4");
  EXPECT_EQ(reversed.read(), -4294967300);
}

TEST_F(EncoderTest, Garbage_CostsItselfAlone) {
  tree_.add_counter(0, kName);
  encoder_.look();
  EXPECT_EQ(read_count("7"), 7);
  for (const char* text : {"", "x", "7.5", "99999999999999999999", "\x80\xff"}) {
    EXPECT_EQ(read_count(text), std::nullopt) << text;
    EXPECT_EQ(encoder_.status().state, SensorState::kGarbage);
  }
  EXPECT_EQ(encoder_.garbage(), 5u);
  EXPECT_EQ(read_count("9"), 9);
  EXPECT_EQ(encoder_.status().state, SensorState::kRunning);
}

TEST_F(EncoderTest, ReadThatFails_IsUnreadableUntilItDoesNot) {
  tree_.add_counter(0, kName);
  const std::string count = test::SysfsTree::counter(0) + "/count0/count";
  tree_.remove(count);
  std::filesystem::create_directory(tree_.root() / count);  // opens, and cannot be read
  encoder_.look();
  EXPECT_EQ(encoder_.read(), std::nullopt);
  EXPECT_EQ(encoder_.status().state, SensorState::kUnreadable);
  EXPECT_EQ(encoder_.failed_reads(), 1u);
  std::filesystem::remove(tree_.root() / count);
  tree_.set_count(0, "3");
  encoder_.look();
  EXPECT_EQ(encoder_.read(), 3);
}

TEST_F(EncoderTest, CounterThatComesBackUnderAnotherNumber_IsFoundAgain) {
  tree_.add_counter(0, kName);
  encoder_.look();
  EXPECT_EQ(read_count("7"), 7);
  tree_.remove(test::SysfsTree::counter(0));
  encoder_.look();
  EXPECT_EQ(encoder_.status().state, SensorState::kAbsent);
  EXPECT_EQ(encoder_.read(), std::nullopt);
  tree_.add_counter(3, kName);
  tree_.set_count(3, "1");
  encoder_.look();
  EXPECT_TRUE(encoder_.read());
  EXPECT_EQ(encoder_.status().state, SensorState::kRunning);
}

TEST_F(EncoderTest, Frozen_IsAStateOfOneThatRuns) {
  encoder_.set_frozen(true);
  EXPECT_EQ(encoder_.status().state, SensorState::kAbsent);
  tree_.add_counter(0, kName);
  encoder_.look();
  encoder_.set_frozen(true);
  EXPECT_EQ(encoder_.status().state, SensorState::kFrozen);
  EXPECT_EQ(encoder_.read(), 0);
  EXPECT_EQ(encoder_.status().state, SensorState::kFrozen);
  encoder_.set_frozen(false);
  EXPECT_EQ(encoder_.status().state, SensorState::kRunning);
}

}  // namespace
}  // namespace cornerd::drivers
