// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>

#include "core/geometry/squared.hpp"

namespace cornerd::core {

/// Notices that a learned number is no longer true. One that is right the fixes pull now this way
/// and now that; one that changed (another floor, a load, a tyre) they pull the same way again and
/// again, each by too little to be noticed.
class PullWatch {
 public:
  /// What a fix says of the number, in units of what chance makes of it.
  void add(double pull) {
    pulls_ = kKept * pulls_ + pull;
    variance_ = squared(kKept) * variance_ + 1;
  }

  /// Chance alone comes to 3.1 in drives of 600 fixes; wheels that are off by 1 % all of a sudden
  /// to 25.
  bool is_one_sided() const { return std::abs(pulls_) > kOneSided * std::sqrt(variance_); }

 private:
  /// Thirty fixes, four seconds.
  static constexpr double kKept = 0.97;
  static constexpr double kOneSided = 5;

  double pulls_ = 0;
  double variance_ = 0;
};

}  // namespace cornerd::core
