// SPDX-License-Identifier: MIT
#include "core/recognition/pose_table.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace cornerd::core {
namespace {

TEST(PoseTable, RepeatedPose_IsStoredOnceWithCount) {
  PoseTable table(100);
  for (int k = 0; k < 5; ++k) table.add({1.02 + 0.001 * k, -2.02, 0.3});
  table.add({1.02, -2.02, 1.3});
  table.add({9, -2.02, 0.3});
  const auto places = table.most_voted(100);
  ASSERT_EQ(places.size(), 3U);
  EXPECT_EQ(std::max_element(places.begin(), places.end(),
                             [](auto& a, auto& b) { return a.votes < b.votes; })
                ->votes,
            5);
}

TEST(PoseTable, MorePosesThanCount_MostVotedStay) {
  PoseTable table(2000);
  for (int round = 0; round < 3; ++round) {
    for (int i = 0; i < 500; ++i) {
      if (round == 0 || i % 50 == 7) table.add({0.5 * i, 0.04, 0});
    }
  }
  const auto places = table.most_voted(10);
  ASSERT_EQ(places.size(), 10U);
  for (const PoseHypothesis& place : places) EXPECT_EQ(place.votes, 3);
}

TEST(PoseTable, FullTable_StillCounts) {
  PoseTable table(16);
  for (int round = 0; round < 2; ++round) {
    for (int i = 0; i < 40; ++i) table.add({1.0 * i, 0, 0});
  }
  const auto places = table.most_voted(100);
  ASSERT_EQ(places.size(), 16U);
  for (const PoseHypothesis& place : places) EXPECT_EQ(place.votes, 2);
  table.clear();
  EXPECT_TRUE(table.most_voted(100).empty());
}

}  // namespace
}  // namespace cornerd::core
