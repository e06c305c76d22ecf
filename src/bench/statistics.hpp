// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

namespace cornerd::bench {

struct MeanAndDeviation {
  double mean = 0;
  double deviation = 0;  ///< standard deviation of a single value; 0 for fewer than two
};
MeanAndDeviation mean_and_deviation(const std::vector<double>& values);

/// Interpolated between the values next to that rank, 0 for none. `sorted`: by rising value.
double quantile(const std::vector<double>& sorted, double share);

/// What a boxplot shows (Tukey): the box is the quartiles, the whiskers reach to the farthest
/// values within 1.5 box lengths of it, what lies beyond is drawn one by one.
struct BoxplotStatistics {
  double lower_whisker = 0;
  double lower_quartile = 0;
  double median = 0;
  double upper_quartile = 0;
  double upper_whisker = 0;
  std::vector<double> outliers;  ///< by rising value
};
BoxplotStatistics boxplot_of(std::vector<double> values);

}  // namespace cornerd::bench
