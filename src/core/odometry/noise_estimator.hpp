// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "core/geometry/squared.hpp"

namespace cornerd::core {

/// Estimates how much larger or smaller a noise is than modelled, from squared residuals that have
/// other noise in them as well: the mean over a few factors by their posteriors (multiple-model
/// estimation, Magill 1965). Variances in any unit; the factor is one of variances.
class NoiseEstimator {
 public:
  /// The factor's bounds; the prior is log-normal about 1.
  NoiseEstimator(double least, double most) {
    for (std::size_t i = 0; i < kModels; ++i) {
      const double share = static_cast<double>(i) / (kModels - 1);
      factors_[i] = least * std::pow(most / least, share);
      log_prior_[i] = -squared(std::log(factors_[i]) / kPriorSigma) / 2;
    }
    log_posterior_ = log_prior_;
    factor_ = mean();
  }

  /// `squared`: the residual's; `modelled`: its variance by the noise as modelled; `other`: by all
  /// else.
  void add(double squared, double modelled, double other) {
    if (!(modelled > 0)) return;
    for (std::size_t i = 0; i < kModels; ++i) {
      const double variance = factors_[i] * modelled + std::max(other, 0.0);
      log_posterior_[i] = kMemory * log_posterior_[i] + (1 - kMemory) * log_prior_[i] -
                          (std::log(variance) + std::min(squared / variance, kOutlier)) / 2;
    }
    factor_ = mean();
  }

  double factor() const { return factor_; }

 private:
  static constexpr std::size_t kModels = 12;
  /// Of the logarithm: from a gyro's data sheet to one on a robot that vibrates is a factor of ten
  /// in standard deviations, two sigma.
  static constexpr double kPriorSigma = 2.3;
  /// Older residuals fade, as floors and tyres change: a thousand scans.
  static constexpr double kMemory = 0.999;
  /// A residual beyond four sigma counts as one of four.
  static constexpr double kOutlier = 16;

  double mean() {
    const double most = *std::max_element(log_posterior_.begin(), log_posterior_.end());
    double sum = 0;
    double weighted = 0;
    for (std::size_t i = 0; i < kModels; ++i) {
      log_posterior_[i] -= most;
      const double weight = std::exp(log_posterior_[i]);
      sum += weight;
      weighted += weight * factors_[i];
    }
    return weighted / sum;
  }

  std::array<double, kModels> factors_;
  std::array<double, kModels> log_prior_;
  std::array<double, kModels> log_posterior_;
  double factor_;
};

}  // namespace cornerd::core
