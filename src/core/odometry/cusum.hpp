// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>

#include "core/geometry/squared.hpp"

namespace cornerd::core {

/// Detects a change of a parameter from innovations: a two-sided cumulative sum with exponential
/// forgetting (Page 1954; Lucas and Saccucci 1990).
class Cusum {
 public:
  /// An innovation along the parameter, normalised to unit variance.
  void add(double innovation) {
    sum_ = kForgetting * sum_ + innovation;
    variance_ = squared(kForgetting) * variance_ + 1;
  }
  /// Constant parameters reached 3.1 sigma in drives of 600 fixes, wheels that change by 1 % 25.
  bool is_change() const { return std::abs(sum_) > kThreshold * std::sqrt(variance_); }

 private:
  static constexpr double kForgetting = 0.97;  ///< of a fix: thirty of them, four seconds
  static constexpr double kThreshold = 5;

  double sum_ = 0;
  double variance_ = 0;
};

}  // namespace cornerd::core
