// SPDX-License-Identifier: MIT
#include "bench/statistics.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace cornerd::bench {
namespace {

TEST(MeanAndDeviation, Sample_DividesByCountMinusOne) {
  const MeanAndDeviation result = mean_and_deviation({2, 4, 4, 4, 5, 5, 7, 9});
  EXPECT_DOUBLE_EQ(result.mean, 5);
  EXPECT_DOUBLE_EQ(result.deviation, std::sqrt(32.0 / 7));
}

TEST(MeanAndDeviation, FewerThanTwoValues_DeviationZero) {
  EXPECT_EQ(mean_and_deviation({}).mean, 0);
  EXPECT_EQ(mean_and_deviation({3}).mean, 3);
  EXPECT_EQ(mean_and_deviation({3}).deviation, 0);
}

TEST(Quantile, BetweenTwoValues_IsInterpolated) {
  EXPECT_DOUBLE_EQ(quantile({1, 2, 3, 4}, 0.5), 2.5);
  EXPECT_DOUBLE_EQ(quantile({1, 2, 3, 4}, 0), 1);
  EXPECT_DOUBLE_EQ(quantile({1, 2, 3, 4}, 1), 4);
  EXPECT_DOUBLE_EQ(quantile({10, 20}, 0.95), 19.5);
  EXPECT_EQ(quantile({}, 0.5), 0);
}

TEST(ClopperPearson, TextbookIntervals) {
  EXPECT_NEAR(clopper_pearson(4, 20).low, 0.0573, 1e-4);
  EXPECT_NEAR(clopper_pearson(4, 20).high, 0.4366, 1e-4);
  EXPECT_EQ(clopper_pearson(0, 100).low, 0);
  EXPECT_NEAR(clopper_pearson(0, 100).high, 1 - std::pow(0.025, 0.01), 1e-6);
  EXPECT_EQ(clopper_pearson(100, 100).high, 1);
  EXPECT_NEAR(clopper_pearson(100, 100).low, std::pow(0.025, 0.01), 1e-6);
}

TEST(Boxplot, ElevenValues_TukeyStatistics) {
  // Quartiles 3.5 and 8.5: whiskers reach at most to -4 and 16.
  const BoxplotStatistics plot = boxplot_of({40, 1, 2, 3, 4, 5, 6, 7, 8, 9, 16});
  EXPECT_DOUBLE_EQ(plot.lower_quartile, 3.5);
  EXPECT_DOUBLE_EQ(plot.median, 6);
  EXPECT_DOUBLE_EQ(plot.upper_quartile, 8.5);
  EXPECT_DOUBLE_EQ(plot.lower_whisker, 1);
  EXPECT_DOUBLE_EQ(plot.upper_whisker, 16);
  EXPECT_THAT(plot.outliers, testing::ElementsAre(40));
}

TEST(Boxplot, EqualValues_BoxOfZeroHeight) {
  const BoxplotStatistics plot = boxplot_of({2, 2, 2});
  EXPECT_EQ(plot.lower_whisker, 2);
  EXPECT_EQ(plot.median, 2);
  EXPECT_EQ(plot.upper_whisker, 2);
  EXPECT_TRUE(plot.outliers.empty());
  EXPECT_EQ(boxplot_of({}).median, 0);
}

}  // namespace
}  // namespace cornerd::bench
