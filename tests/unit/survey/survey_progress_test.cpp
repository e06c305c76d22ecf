// SPDX-License-Identifier: MIT
#include "survey/survey_progress.hpp"

#include <gtest/gtest.h>

#include <string>

namespace cornerd::survey {
namespace {

TEST(ProgressShares, RepeatedPass_NeverDecreases) {
  std::string shown;
  ProgressShares shares(
      [&](std::string_view phase, double share) {
        shown +=
            std::string(phase) + " " + std::to_string(static_cast<int>(share * 100 + 0.5)) + ", ";
      },
      /*scans=*/4);
  const Progress pass = shares.pass("one", 0.2, 0.6);
  pass(0);
  pass(3);
  pass(1);
  shares.pass("two", 0.1, 0.9)(4);
  shares.rest()("alone", 0.5);
  EXPECT_EQ(shown, "one 20, one 50, one 50, two 90, alone 95, ");
}

TEST(ProgressShares, NoCallback_GivesNoPass) {
  ProgressShares shares({}, 4);
  EXPECT_FALSE(shares.pass("one", 0, 1));
  EXPECT_FALSE(shares.rest());
}

}  // namespace
}  // namespace cornerd::survey
