// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "core/geometry/squared.hpp"

namespace cornerd::core {

/// A sum whose error is a random walk (a heading by a gyro, the wheels' angle beside it), compared
/// with a measurement of the sum whose error is white. All but innovation and correction are
/// variances, in any unit.
struct WalkStep {
  double innovation = 0;  ///< of the filter that is adapted
  double correction = 0;  ///< of that filter's sum by this measurement
  double walk = 0;        ///< since the last measurement, by the noise as modelled
  double other = 0;       ///< since the last measurement, by other causes
  /// The walk in the time over which a measurement averages the sum, as modelled: between averages
  /// over adjacent times a random walk has a third of that less. (They are correlated; that is
  /// neglected.)
  double averaged = 0;
  double noise = 0;  ///< of the measurement, without the walk in it
  double floor = 0;  ///< of the measurement, the largest that is unknown
};

/// Estimates how much larger or smaller a noise is than modelled, from residuals that have other
/// noise in them as well: the mean over a few factors of variances by their posteriors
/// (multiple-model estimation, Magill 1965). With more than one floor it also estimates which share
/// of WalkStep::floor is there: each pair of factor and share is a Kalman filter of its own, since
/// a walk and white noise differ in how one innovation follows another, not in their size (Mehra
/// 1970).
template <std::size_t kFloors>
class NoiseBank {
 public:
  /// The factors' bounds, the floor's up to 1; the prior is log-normal about 1.
  NoiseBank(double least, double most, double least_floor = 1) {
    for (std::size_t i = 0; i < kModels; ++i) {
      Model& model = models_[i];
      model.factor = least * std::pow(most / least, share_of(i / kFloors, kFactors));
      model.floor = std::pow(least_floor, 1 - share_of(i % kFloors, kFloors));
      model.log_prior = -(squared(std::log(model.factor)) + squared(std::log(model.floor))) /
                        squared(kPriorSigma) / 2;
      model.log_posterior = model.log_prior;
    }
    update_means();
  }

  /// `squared`: the residual's; `modelled`: its variance by the noise as modelled; `other`: by all
  /// else.
  void add(double squared, double modelled, double other) {
    if (!(modelled > 0)) return;
    for (Model& model : models_) {
      model.update_posterior(squared, model.factor * modelled + std::max(other, 0.0));
    }
    update_means();
  }

  void add(const WalkStep& step) {
    if (is_interrupted_) return restart(step);
    for (Model& model : models_) {
      const double noise = model.noise_of(step);
      const double walk = model.factor * (step.walk - step.averaged / 3);
      const double before = model.variance + step.other + walk;
      const double variance = std::max(before + noise, kLeastVariance);
      const double residual = step.innovation - model.offset;
      model.update_posterior(squared(residual), variance);
      model.offset += before / variance * residual - step.correction;
      model.variance = before * noise / variance;
    }
    update_means();
  }
  /// The sum starts again from this measurement.
  void restart(const WalkStep& step) {
    is_interrupted_ = false;
    for (Model& model : models_) {
      model.offset = step.innovation - step.correction;
      model.variance = model.noise_of(step);
    }
  }
  /// The sum starts again from the next measurement.
  void interrupt() { is_interrupted_ = true; }
  /// The measurements are those of `other` from now on: their floor is as estimated there.
  void take_floor(const NoiseBank& other) {
    std::array<double, kFactors> of_factor{};
    std::array<double, kFloors> of_floor{};
    for (std::size_t i = 0; i < kModels; ++i) {
      of_factor[i / kFloors] += std::exp(models_[i].log_posterior);
      of_floor[i % kFloors] += std::exp(other.models_[i].log_posterior);
    }
    for (std::size_t i = 0; i < kModels; ++i) {
      models_[i].log_posterior =
          std::log(std::max(of_factor[i / kFloors] * of_floor[i % kFloors], kLeastWeight));
    }
    update_means();
  }

  double factor() const { return factor_; }
  double floor() const { return floor_; }

 private:
  static constexpr std::size_t kFactors = 12;
  static constexpr std::size_t kModels = kFactors * kFloors;
  /// Of the logarithm: from a gyro's data sheet to one on a robot that vibrates is a factor of ten
  /// in standard deviations, two sigma.
  static constexpr double kPriorSigma = 2.3;
  /// Older residuals fade, as floors and tyres change: a thousand scans.
  static constexpr double kMemory = 0.999;
  /// A residual beyond four sigma counts as one of four.
  static constexpr double kOutlier = 16;
  static constexpr double kLeastVariance = 1e-12;
  static constexpr double kNegligible = -20;  ///< log of a share of the mean
  static constexpr double kLeastWeight = 1e-100;

  struct Model {
    double factor = 1;
    double floor = 1;
    double log_prior = 0;
    double log_posterior = 0;
    double offset = 0;    ///< of the sum, from that of the filter that is adapted
    double variance = 0;  ///< of it

    double noise_of(const WalkStep& step) const { return step.noise + floor * step.floor; }
    void update_posterior(double squared, double expected) {
      log_posterior = kMemory * log_posterior + (1 - kMemory) * log_prior -
                      (std::log(expected) + std::min(squared / expected, kOutlier)) / 2;
    }
  };

  static double share_of(std::size_t i, std::size_t n) {
    return n > 1 ? static_cast<double>(i) / static_cast<double>(n - 1) : 1;
  }
  void update_means() {
    double most = models_.front().log_posterior;
    for (const Model& model : models_) most = std::max(most, model.log_posterior);
    double sum = 0;
    factor_ = floor_ = 0;
    for (Model& model : models_) {
      model.log_posterior -= most;
      if (model.log_posterior < kNegligible) continue;
      const double weight = std::exp(model.log_posterior);
      sum += weight;
      factor_ += weight * model.factor;
      floor_ += weight * model.floor;
    }
    factor_ /= sum;
    floor_ /= sum;
  }

  std::array<Model, kModels> models_;
  bool is_interrupted_ = true;
  double factor_ = 1;
  double floor_ = 1;
};

using NoiseEstimator = NoiseBank<1>;
using WalkNoiseEstimator = NoiseBank<3>;

}  // namespace cornerd::core
