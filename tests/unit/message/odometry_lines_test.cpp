// SPDX-License-Identifier: MIT
#include "message/odometry_lines.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <utility>

namespace cornerd::message {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;

class OdometryLinesTest : public ::testing::Test {
 protected:
  OdometryLinesTest() {
    summary_.enabled = true;
    static_cast<void>(hint());
  }
  void hear(const core::OdometryReading& reading, int times = 50) {
    for (int i = 0; i < times; ++i) lines_.add(reading);
  }
  /// A second later.
  std::string hint() {
    t_ns_ += core::kNsPerSecond;
    return std::string(lines_.hint(summary_, t_ns_));
  }

  OdometryLines lines_;
  core::OdometrySummary summary_;
  core::TimeNs t_ns_ = 0;
};

TEST_F(OdometryLinesTest, WhatLinesLack_IsNamed) {
  EXPECT_THAT(hint(), HasSubstr("no ODOMETRY line"));
  hear({0, {}, {}, 0.1});
  EXPECT_THAT(hint(), HasSubstr("lack left and right: a gyro alone"));
  hear({0, 1, {}, 0.1});
  EXPECT_THAT(hint(), HasSubstr("lack right"));
  hear({0, {}, 1, {}});
  EXPECT_THAT(hint(), HasSubstr("lack left:"));
  hear({0, 1, {}, {}});
  hear({0, {}, 1, {}});
  EXPECT_THAT(hint(), HasSubstr("left or right: both belong into one line"));
  hear({});
  EXPECT_THAT(hint(), HasSubstr("lack left, right and gyro"));
}

TEST_F(OdometryLinesTest, WholeLinesThatAreRefused_AreExplained) {
  hear({0, 1, 1, {}});
  EXPECT_THAT(hint(), IsEmpty());
  hear({0, 1, 1, {}});
  summary_.counters.future += 40;
  EXPECT_THAT(hint(), HasSubstr("ahead of the lidar's"));
  hear({0, 1, 1, {}});
  summary_.counters.past += 40;
  EXPECT_THAT(hint(), HasSubstr("behind the lidar's"));
  hear({0, 1, 1, {}});
  summary_.counters.jumps += 40;
  EXPECT_THAT(hint(), HasSubstr("advanced.odometry.max_speed"));
}

TEST_F(OdometryLinesTest, WhatIsRefusedOfMostLines_IsKnown) {
  const auto counts_and_gyro = [&](int past, int jumps, int gyro) {
    hear({0, 1, 1, 0.1});
    summary_.counters.past += past;
    summary_.counters.jumps += jumps;
    summary_.counters.gyro += gyro;
    static_cast<void>(hint());
    return std::pair(lines_.refused().counts, lines_.refused().gyro);
  };
  EXPECT_EQ(counts_and_gyro(20, 20, 20), std::pair(false, false));
  EXPECT_EQ(counts_and_gyro(40, 0, 0), std::pair(true, true));
  EXPECT_EQ(counts_and_gyro(0, 40, 0), std::pair(true, false));
  EXPECT_EQ(counts_and_gyro(0, 0, 40), std::pair(false, true));
  static_cast<void>(hint());
  EXPECT_FALSE(lines_.refused().counts) << "nobody sends any";
  summary_.counters = {};
  EXPECT_EQ(counts_and_gyro(0, 0, 0), std::pair(false, false)) << "counted anew";
}

TEST_F(OdometryLinesTest, OdometryThatIsThere_HasNoHint) {
  summary_.present = true;
  hear({0, {}, {}, 0.1});
  EXPECT_THAT(hint(), IsEmpty());
}

TEST_F(OdometryLinesTest, TwoQuestionsInAMoment_AreAnsweredAlike) {
  hear({0, {}, 1, {}});
  const std::string first = hint();
  EXPECT_EQ(lines_.hint(summary_, t_ns_ + 1000), first);
  EXPECT_EQ(lines_.hint(summary_, t_ns_ - core::kNsPerSecond), first) << "a clock that was set";
}

}  // namespace
}  // namespace cornerd::message
