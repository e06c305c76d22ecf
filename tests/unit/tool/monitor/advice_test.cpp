// SPDX-License-Identifier: MIT
#include "tool/monitor/advice.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "monitor/daemon_lines.hpp"

namespace cornerd::tool {
namespace {

using testing::HasSubstr;

class AdviceTest : public testing::Test {
 protected:
  AdviceTest() { state_.connect(0); }
  void take_line(const std::string& line, int times = 1) {
    for (int i = 0; i < times; ++i) state_.take_line(line, now_ns_ += core::kNsPerSecond / 10);
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

TEST_F(AdviceTest, FixesOfRunningLidar_AreGood) {
  take_line(status_line());
  take_line(kFixLine, 3);
  expect(Style::kGood, "all is well", "");
}

TEST_F(AdviceTest, NoDaemon_PrecedesOtherAdvice) {
  expect(Style::kDim, "waiting for the daemon's first message", "");
  take_line(status_line());
  now_ns_ += 9 * core::kNsPerSecond / 2;
  expect(Style::kBad, "no message from the daemon for 4 s", "doctor");
  state_.lose("/run/pose.sock: No such file", 0);
  now_ns_ = 12 * core::kNsPerSecond;
  expect(Style::kBad, "no daemon since 12 s: /run/pose.sock: No such file",
         "systemctl start cornerd");
}

TEST_F(AdviceTest, LidarFault_ShowsItsDetail) {
  take_line(status_line(R"("state":"starting")"));
  expect(Style::kWarning, "lidar starting", "");
  take_line(status_line(R"("state":"faulty","fault":"dead-laser","detail":"is it covered?")"));
  take_line(kFixLine);
  expect(Style::kBad, "lidar faulty, dead-laser", "is it covered?");
}

TEST_F(AdviceTest, NoScans_AdvisesDoctor) {
  take_line(status_line());
  expect(Style::kWarning, "the lidar runs, but no scan is complete yet", "");
  take_line(kFixLine, 5);
  now_ns_ += 5 * core::kNsPerSecond / 2;
  expect(Style::kBad, "the lidar runs, but no scans come", "doctor");
}

TEST_F(AdviceTest, EachStateWithoutPose_HasOwnAdvice) {
  take_line(status_line());
  take_line(kLostLine);
  expect(Style::kBad, "no pose in the map fits the scan", "lidar.mount");
  take_line(kAmbiguousLine);
  expect(Style::kWarning, "2 poses fit the scan", "map check");
  take_line(kPredictedLine);
  expect(Style::kWarning, "dead reckoned for 1.2 s", "covered");
}

TEST_F(AdviceTest, TooFewFixes_AreCounted) {
  take_line(status_line());
  take_line(kLostLine, 5);
  take_line(kFixLine, 14);
  expect(Style::kGood, "all is well", "");
  take_line(kFixLine);
  expect(Style::kWarning, "5 of the last 20 scans gave no pose", "unmapped obstacles");
}

TEST_F(AdviceTest, SensorsLineAndMessages_FollowOtherAdvice) {
  take_line(kFixLine, 2);
  take_line(
      status_line(R"("state":"running")", R"(,"counters":{"bytes":1000,"skipped_bytes":30})"));
  expect(Style::kWarning, "3.0 % of the lidar's bytes were damaged", "cable");
  take_line(status_line(R"("state":"running")",
                        R"(,"odometry":{"state":"running","sensors":{"gyro":{"state":"running"},)"
                        R"("left":{"state":"stuck","detail":"does it turn?"}}})"));
  expect(Style::kWarning, "odometry: left is stuck", "does it turn?");
  take_line(status_line(R"("state":"running")",
                        R"(,"odometry":{"state":"absent","hint":"lines lack left"})"));
  expect(Style::kWarning, "odometry: lines lack left", "doctor");
  take_line(status_line());
  take_line("hello");
  EXPECT_THAT(advice().what, HasSubstr("invalid message"));
}

}  // namespace
}  // namespace cornerd::tool
