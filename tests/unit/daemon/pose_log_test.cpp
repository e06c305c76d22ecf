// SPDX-License-Identifier: MIT
#include "daemon/pose_log.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace cornerd::daemon {
namespace {

constexpr core::TimeNs kScan_ns = 140'000'000;

class PoseLogTest : public ::testing::Test {
 protected:
  void scans(core::PoseState state, double duration_s) {
    core::PoseEstimate pose;
    pose.state = state;
    pose.T_map_base = {1, 2, 0};
    for (const core::TimeNs end_ns = t_ns_ + core::from_seconds(duration_s); t_ns_ < end_ns;
         t_ns_ += kScan_ns) {
      if (const auto line = log_.add(pose, t_ns_)) lines_.push_back(*line);
    }
  }

  std::vector<std::string> take() { return std::exchange(lines_, {}); }

  PoseLog log_;
  core::TimeNs t_ns_ = 0;
  std::vector<std::string> lines_;
};

using Lines = std::vector<std::string>;

TEST_F(PoseLogTest, FirstFix_SaidOnce) {
  scans(core::PoseState::kLost, 5);
  scans(core::PoseState::kFix, 60);
  scans(core::PoseState::kTracking, 60);
  EXPECT_EQ(take(), Lines{"first fix: x 1.000 m, y 2.000 m, theta 0.0 degrees"});
}

TEST_F(PoseLogTest, Loss_SaidOnceAfterTenSeconds_AndItsEnd) {
  scans(core::PoseState::kFix, 1);
  take();
  for (int round = 0; round < 2; ++round) {
    scans(core::PoseState::kLost, 9.9);
    EXPECT_EQ(take(), Lines{});
    scans(core::PoseState::kAmbiguous, 20);
    EXPECT_EQ(take(), Lines{"lost for 10 s: no scan gives a pose (ambiguous)"});
    scans(core::PoseState::kFix, 1);
    EXPECT_EQ(take(), Lines{"found again after 30 s: x 1.000 m, y 2.000 m, theta 0.0 degrees"});
  }
}

TEST_F(PoseLogTest, ShortLosses_SayNothing) {
  scans(core::PoseState::kFix, 1);
  take();
  for (int round = 0; round < 100; ++round) {
    scans(core::PoseState::kLost, 9);
    scans(core::PoseState::kTracking, 0.2);
  }
  EXPECT_EQ(take(), Lines{});
}

TEST_F(PoseLogTest, RecordingThatRestarts_CountsFromItsBeginning) {
  scans(core::PoseState::kLost, 9);
  t_ns_ = 0;
  scans(core::PoseState::kLost, 9);
  EXPECT_EQ(take(), Lines{});
  scans(core::PoseState::kLost, 2);
  EXPECT_EQ(take(), Lines{"lost for 10 s: no scan gives a pose (lost)"});
}

}  // namespace
}  // namespace cornerd::daemon
