// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <vector>

namespace cornerd::bench {

struct MeanAndDeviation {
  double mean = 0;
  double deviation = 0;  ///< standard deviation of a single value; 0 for fewer than two
};
MeanAndDeviation mean_and_deviation(const std::vector<double>& values);

/// Interpolated linearly; 0 for no values. `sorted`: ascending.
double quantile(const std::vector<double>& sorted, double share);

struct Interval {
  double low = 0;
  double high = 1;
};
/// Of the probability of what happened `count` times in `trials`, with 95 % confidence (Clopper and
/// Pearson 1934).
Interval clopper_pearson(std::size_t count, std::size_t trials);

/// Tukey's boxplot: the box spans the quartiles, the whiskers reach to the farthest values
/// within 1.5 box lengths, values beyond are outliers.
struct BoxplotStatistics {
  double lower_whisker = 0;
  double lower_quartile = 0;
  double median = 0;
  double upper_quartile = 0;
  double upper_whisker = 0;
  std::vector<double> outliers;  ///< ascending
};
BoxplotStatistics boxplot_of(std::vector<double> values);

}  // namespace cornerd::bench
