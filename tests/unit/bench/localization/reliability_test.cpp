// SPDX-License-Identifier: MIT
#include "bench/localization/reliability.hpp"

#include <gtest/gtest.h>

namespace cornerd::bench {
namespace {

core::PoseEstimate answer(core::PoseState state, double doubt) {
  core::PoseEstimate estimate;
  estimate.state = state;
  estimate.p_wrong = doubt;
  estimate.T_map_base = {1, 2, 0};
  if (state == core::PoseState::kAmbiguous) {
    estimate.T_map_base = {};
    estimate.alternatives = {{{1, 2, 0}, 1 - doubt}, {{5, 2, 0}, doubt}};
  }
  return estimate;
}

TEST(Reliability, Answers_AreSortedByTheirDoubt) {
  Reliability reliability;
  reliability.add(answer(core::PoseState::kFix, 1e-8), {1, 2, 0});
  reliability.add(answer(core::PoseState::kFix, 1e-9), {5, 2, 0});
  reliability.add(answer(core::PoseState::kAmbiguous, 0.4), {1, 2, 0});
  reliability.add(answer(core::PoseState::kAmbiguous, 0.3), {5, 2, 0});
  reliability.add(answer(core::PoseState::kLost, 0.5), {5, 2, 0});
  const auto& bins = reliability.bins();
  EXPECT_EQ(bins.front().scans, 2u);
  EXPECT_EQ(bins.front().wrong, 1u);
  EXPECT_EQ(bins.back().scans, 2u);
  EXPECT_EQ(bins.back().wrong, 1u);
  EXPECT_NEAR(bins.back().doubt, 0.7, 1e-12);
}

TEST(Reliability, SumOfTwo_CountsBoth) {
  Reliability one;
  one.add(answer(core::PoseState::kAmbiguous, 0.002), {5, 2, 0});
  Reliability sum = one;
  sum.add(one);
  EXPECT_EQ(sum.bins()[3].scans, 2u);
  EXPECT_EQ(sum.bins()[3].wrong, 2u);
}

}  // namespace
}  // namespace cornerd::bench
