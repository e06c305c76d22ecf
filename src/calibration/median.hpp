// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

namespace cornerd::calibration {

/// Of a normal distribution: sigma over the median of the absolute values.
inline constexpr double kMedianToSigma = 1.4826;

/// The value that `share` of the values do not exceed; 0 for none. Reorders its copy.
inline double quantile(std::vector<double> values, double share) {
  if (values.empty()) return 0;
  const auto rank = static_cast<std::size_t>(share * static_cast<double>(values.size() - 1) + 0.5);
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(rank);
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

struct Weighted {
  double value = 0;
  double weight = 0;
};

/// The value with half of the weight below it; 0 for none.
inline double weighted_median(std::vector<Weighted> values) {
  std::sort(values.begin(), values.end(),
            [](const Weighted& a, const Weighted& b) { return a.value < b.value; });
  double whole = 0;
  for (const Weighted& value : values) whole += value.weight;
  double sum = 0;
  for (const Weighted& value : values) {
    sum += value.weight;
    if (2 * sum >= whole) return value.value;
  }
  return 0;
}

inline double median(std::vector<double> values) { return quantile(std::move(values), 0.5); }

}  // namespace cornerd::calibration
