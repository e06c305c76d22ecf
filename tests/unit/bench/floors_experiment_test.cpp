// SPDX-License-Identifier: MIT
#include "bench/floors_experiment.hpp"

#include <gtest/gtest.h>

namespace cornerd::bench {
namespace {

/// A sample of `cornerd-bench --floors`.
TEST(FloorsExperiment, LikeFloors_NeverAWrongOne) {
  for (const MapSet& set : map_sets(7)) {
    const FloorScore score = run_map_set(set, 5, 7, [](std::size_t) {});
    EXPECT_EQ(score.wrong + score.without_truth, 0U) << set.title;
    EXPECT_EQ(score.wrong_poses, 0U) << set.title;
    if (set.title == "a floor twice, eight others") {
      EXPECT_EQ(score.right, 0U);
    }
    if (set.title == "ten flats") {
      EXPECT_GE(score.right, 4U);
    }
    if (set.taken_in == 0) {
      EXPECT_EQ(score.none, score.starts);
    }
  }
}

}  // namespace
}  // namespace cornerd::bench
