// SPDX-License-Identifier: MIT
#include "tool/monitor/advice.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "monitor/told.hpp"

namespace cornerd::tool {
namespace {

using testing::HasSubstr;

class AdviceTest : public testing::Test {
 protected:
  AdviceTest() { state_.connect(0); }
  void hear(const std::string& line, int times = 1) {
    for (int i = 0; i < times; ++i) state_.hear(line, now_ns_ += core::kNsPerSecond / 10);
  }
  Advice advice() const { return advise(state_, now_ns_); }
  void expect(Style style, const std::string& what, const std::string& mend) const {
    EXPECT_EQ(advice().style, style);
    EXPECT_EQ(advice().what, what);
    EXPECT_THAT(advice().mend, HasSubstr(mend));
  }
  MonitorState state_;
  core::TimeNs now_ns_ = 0;
};

TEST_F(AdviceTest, FixesOfARunningLidar_AreWell) {
  hear(status_line());
  hear(kFixLine, 3);
  expect(Style::kGood, "all is well", "");
}

TEST_F(AdviceTest, Daemon_IsMissedFirst) {
  expect(Style::kDim, "waiting for the daemon's first word", "");
  hear(status_line());
  now_ns_ += 9 * core::kNsPerSecond / 2;
  expect(Style::kBad, "the daemon has said nothing for 4 s", "doctor");
  state_.lose("/run/pose.sock: No such file", 0);
  now_ns_ = 12 * core::kNsPerSecond;
  expect(Style::kBad, "no daemon since 12 s: /run/pose.sock: No such file",
         "systemctl start cornerd");
}

TEST_F(AdviceTest, Lidar_SpeaksForItself) {
  hear(status_line(R"("state":"starting")"));
  expect(Style::kDoubt, "lidar starting", "");
  hear(status_line(R"("state":"faulty","fault":"dead-laser","detail":"is it covered?")"));
  hear(kFixLine);
  expect(Style::kBad, "lidar faulty, dead-laser", "is it covered?");
}

TEST_F(AdviceTest, TurnsThatDoNotCome_AreMissed) {
  hear(status_line());
  expect(Style::kDoubt, "the lidar runs, and no turn is over yet", "");
  hear(kFixLine, 5);
  now_ns_ += 5 * core::kNsPerSecond / 2;
  expect(Style::kBad, "the lidar runs, and no turns come", "doctor");
}

TEST_F(AdviceTest, EachStateWithoutPlace_HasItsOwn) {
  hear(status_line());
  hear(kLostLine);
  expect(Style::kBad, "no place of the map fits what the lidar sees", "lidar.mount");
  hear(kAmbiguousLine);
  expect(Style::kDoubt, "2 places fit what the lidar sees", "map check");
  hear(kPredictedLine);
  expect(Style::kDoubt, "by wheels and gyro alone for 1.2 s", "covered");
}

TEST_F(AdviceTest, TooFewFixes_AreCounted) {
  hear(status_line());
  hear(kLostLine, 5);
  hear(kFixLine, 14);
  expect(Style::kGood, "all is well", "");
  hear(kFixLine);
  expect(Style::kDoubt, "5 of the last 20 turns named no place", "not on the map");
}

TEST_F(AdviceTest, SensorsLineAndMessages_ComeLast) {
  hear(kFixLine, 2);
  hear(status_line(R"("state":"running")", R"(,"counters":{"bytes":1000,"skipped_bytes":30})"));
  expect(Style::kDoubt, "3.0 % of the lidar's bytes were damaged", "cable");
  hear(status_line(R"("state":"running")",
                   R"(,"odometry":{"state":"running","sensors":{"gyro":{"state":"running"},)"
                   R"("left":{"state":"stuck","detail":"does it turn?"}}})"));
  expect(Style::kDoubt, "odometry: left is stuck", "does it turn?");
  hear(status_line(R"("state":"running")",
                   R"(,"odometry":{"state":"absent","hint":"lines lack left"})"));
  expect(Style::kDoubt, "odometry: lines lack left", "doctor");
  hear(status_line());
  hear("hello");
  EXPECT_THAT(advice().what, HasSubstr("makes no sense"));
}

}  // namespace
}  // namespace cornerd::tool
