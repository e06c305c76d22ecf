// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>

namespace cornerd::core {

/// Learns how much larger or smaller a noise is than modelled, from squared residuals that have
/// other noise in them as well. Variances in any unit; the factor is one of variances.
class NoiseEstimator {
 public:
  /// What was modelled counts as so many observations of that noise alone.
  NoiseEstimator(double weight, double least, double most)
      : weight_(weight), least_(least), most_(most) {}

  /// `squared`: the residual's; `modelled`: its variance by the noise as modelled; `other`: by all
  /// else. Observations in which the noise drowns among others weigh little.
  void add(double squared, double modelled, double other) {
    if (!(modelled > 0)) return;
    const double expected = factor_ * modelled + other;
    const double share =
        std::max(factor_, kSeen) * modelled / (std::max(factor_, kSeen) * modelled + other);
    const double weight = share * share;
    if (!(weight > 0)) return;
    const double surely = std::min(squared, kOutlier * expected);
    weight_ = std::min(weight_ + weight, kMemory);
    factor_ += weight / weight_ * ((surely - other) / modelled - factor_);
    factor_ = std::clamp(factor_, least_, most_);
  }

  double factor() const { return factor_; }

 private:
  /// Older observations fade, as floors and tyres change.
  static constexpr double kMemory = 150;
  /// A residual beyond four sigma counts as one of four.
  static constexpr double kOutlier = 16;
  /// A noise that was found to be tiny is still looked for.
  static constexpr double kSeen = 0.05;

  double factor_ = 1;
  double weight_;
  double least_;
  double most_;
};

}  // namespace cornerd::core
