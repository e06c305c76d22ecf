// SPDX-License-Identifier: MIT
#include "calibration/delay_search.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <optional>
#include <vector>

#include <Eigen/Core>

#include "calibration/robust_statistics.hpp"
#include "core/geometry/linear_solve.hpp"
#include "core/geometry/parabola.hpp"

namespace cornerd::calibration {
namespace {

constexpr double kDelayStep_s = 0.02;
constexpr int kDelaySteps = 30;  ///< to either side
static_assert(kDelaySteps * kDelayStep_s == kMaxDelay_s);
constexpr std::size_t kMinCompared = 10;
constexpr int kDelayRounds = 6;
/// Increase of the robust cost at the configured delay, and at other local minima, from which on
/// the best delay is unambiguous.
constexpr double kAgainst = 40;
constexpr double kAgainstOthers = 25;

/// A linear equation y = share . x, in sigmas.
struct Comparison {
  Eigen::Vector2d x;
  double y = 0;
};

/// Smallest robust (Cauchy) cost over the shares, by iteratively reweighted least squares.
double cost_of(const std::vector<Comparison>& all) {
  Eigen::Vector2d share = Eigen::Vector2d::Zero();
  double cost = 0;
  for (int round = 0; round <= kDelayRounds; ++round) {
    Eigen::Matrix2d information = 1e-9 * Eigen::Matrix2d::Identity();
    Eigen::Vector2d right = Eigen::Vector2d::Zero();
    cost = 0;
    for (const Comparison& equation : all) {
      const double r = equation.y - equation.x.dot(share);
      const double weight = round == 0 ? 1 : cauchy_weight(r);
      information += weight * equation.x * equation.x.transpose();
      right += weight * equation.y * equation.x;
      cost += cauchy_cost(r);
    }
    if (round < kDelayRounds) share = core::inverse(information) * right;
  }
  return cost;
}

/// Cost per window at a delay; nullopt where too few windows are complete.
std::optional<double> cost_at(std::span<const core::OdometryIncrement> steps,
                              std::span<const KnownPose> places, double delay_s) {
  const auto windows = cut_windows(at_true_times(steps, delay_s), places);
  if (windows.size() < kMinCompared) return std::nullopt;
  std::vector<Comparison> translations;
  std::vector<Comparison> wheel_rotations;
  std::vector<Comparison> gyro_rotations;
  for (const DriveWindow& window : windows) {
    Eigen::Vector2d wheels = Eigen::Vector2d::Zero();
    Eigen::Vector2d gyro = Eigen::Vector2d::Zero();
    bool has_gyro = true;
    for (const core::OdometryIncrement& step : window.steps) {
      wheels += Eigen::Vector2d(step.left_m, step.right_m);
      gyro += Eigen::Vector2d(step.gyro_rad, step.duration_s());
      has_gyro = has_gyro && step.has_gyro;
    }
    translations.push_back({wheels / kPoseSigma_m, window.distance_m / kPoseSigma_m});
    wheel_rotations.push_back(
        {wheels / kWheelRotationSigma_rad, window.rotation_rad / kWheelRotationSigma_rad});
    if (has_gyro) {
      gyro_rotations.push_back(
          {gyro / kGyroRotationSigma_rad, window.rotation_rad / kGyroRotationSigma_rad});
    }
  }
  const double cost = cost_of(translations) + cost_of(wheel_rotations) + cost_of(gyro_rotations);
  return cost / static_cast<double>(windows.size());
}

}  // namespace

DelaySearch search_delay(std::span<const core::OdometryIncrement> steps,
                         std::span<const KnownPose> places, double configured_s) {
  DelaySearch search{.delay_s = configured_s};
  std::vector<double> costs;
  const auto as_configured = cost_at(steps, places, configured_s);
  if (!as_configured) return search;
  for (int i = -kDelaySteps; i <= kDelaySteps; ++i) {
    const auto cost = cost_at(steps, places, kDelayStep_s * i);
    if (!cost) return search;
    costs.push_back(*cost);
  }
  const auto best = static_cast<int>(std::ranges::min_element(costs) - costs.begin());
  const double least = costs[best];
  const auto windows = static_cast<double>(cut_windows(steps, places).size());
  // Scales the thresholds where the residuals are larger than modelled.
  const double unit = std::max(1.0, least / 3) / std::max(1.0, windows);
  if (*as_configured < least + kAgainst * unit) return search;
  const int last = 2 * kDelaySteps;
  for (int i = 0; i <= last; ++i) {
    const bool is_least_here =
        (i == 0 || costs[i - 1] >= costs[i]) && (i == last || costs[i + 1] >= costs[i]);
    if (std::abs(i - best) > 2 && is_least_here && costs[i] < least + kAgainstOthers * unit) {
      return search;
    }
  }
  search.is_unambiguous = true;
  search.at_edge = best == 0 || best == last;
  search.delay_s = kDelayStep_s * (best - kDelaySteps);
  if (search.at_edge) return search;
  search.delay_s +=
      kDelayStep_s * core::parabola_minimum(costs[best - 1] - least, costs[best + 1] - least);
  return search;
}

}  // namespace cornerd::calibration
