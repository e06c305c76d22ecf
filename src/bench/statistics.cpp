// SPDX-License-Identifier: MIT
#include "bench/statistics.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace cornerd::bench {
namespace {

/// Probability of at most `count` of `trials`, each with probability `p`.
double binomial_cdf(double count, double trials, double p) {
  double sum = 0;
  for (double k = 0; k <= count; ++k) {
    sum += std::exp(std::lgamma(trials + 1) - std::lgamma(k + 1) - std::lgamma(trials - k + 1) +
                    k * std::log(p) + (trials - k) * std::log1p(-p));
  }
  return sum;
}

}  // namespace

MeanAndDeviation mean_and_deviation(const std::vector<double>& values) {
  MeanAndDeviation result;
  if (values.empty()) return result;
  const auto count = static_cast<double>(values.size());
  result.mean = std::accumulate(values.begin(), values.end(), 0.0) / count;
  if (values.size() < 2) return result;
  double squares = 0;
  for (const double value : values) squares += (value - result.mean) * (value - result.mean);
  result.deviation = std::sqrt(squares / (count - 1));
  return result;
}

double quantile(const std::vector<double>& sorted, double share) {
  if (sorted.empty()) return 0;
  const double rank = share * static_cast<double>(sorted.size() - 1);
  const auto below = static_cast<std::size_t>(rank);
  if (below + 1 >= sorted.size()) return sorted.back();
  return std::lerp(sorted[below], sorted[below + 1], rank - static_cast<double>(below));
}

Interval clopper_pearson(std::size_t count, std::size_t trials) {
  constexpr double kEachSide = 0.025;
  constexpr int kHalvings = 50;
  const auto k = static_cast<double>(count);
  const auto n = static_cast<double>(trials);
  // Where that few become as unlikely as that.
  const auto where = [&](double at_most, double probability) {
    Interval within;
    for (int i = 0; i < kHalvings; ++i) {
      const double middle = std::midpoint(within.low, within.high);
      (binomial_cdf(at_most, n, middle) > probability ? within.low : within.high) = middle;
    }
    return within.low;
  };
  return {count > 0 ? where(k - 1, 1 - kEachSide) : 0, count < trials ? where(k, kEachSide) : 1};
}

BoxplotStatistics boxplot_of(std::vector<double> values) {
  constexpr double kWhiskerBoxes = 1.5;
  BoxplotStatistics plot;
  if (values.empty()) return plot;
  std::sort(values.begin(), values.end());
  plot.lower_quartile = quantile(values, 0.25);
  plot.median = quantile(values, 0.5);
  plot.upper_quartile = quantile(values, 0.75);
  const double reach = kWhiskerBoxes * (plot.upper_quartile - plot.lower_quartile);
  plot.lower_whisker = plot.lower_quartile;
  plot.upper_whisker = plot.upper_quartile;
  for (const double value : values) {
    if (value < plot.lower_quartile - reach || value > plot.upper_quartile + reach) {
      plot.outliers.push_back(value);
      continue;
    }
    plot.lower_whisker = std::min(plot.lower_whisker, value);
    plot.upper_whisker = std::max(plot.upper_whisker, value);
  }
  return plot;
}

}  // namespace cornerd::bench
