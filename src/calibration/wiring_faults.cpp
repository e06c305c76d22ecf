// SPDX-License-Identifier: MIT
#include "calibration/wiring_faults.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include <Eigen/Core>

#include "calibration/odometry_fit.hpp"
#include "calibration/robust_statistics.hpp"
#include "core/geometry/linear_solve.hpp"

namespace cornerd::calibration {
namespace {

constexpr std::size_t kMinEquations = 10;
constexpr int kReweightings = 20;
/// A share must differ from zero by this many sigmas. Large, since slips spoil whole windows.
constexpr double kMinSigmas = 8;
/// Factors between these are within reach of fit_odometry().
constexpr double kMinScale = 0.6;
constexpr double kMaxScale = 1.45;
constexpr double kMaxTrack = 2.2;
/// The bound of fit_odometry(), less the effect of its prior.
constexpr double kMaxBias_rad_s = 0.9 * kMaxFittedScale;
/// Largest ratio between the wheels' factors that is no fault.
constexpr double kMaxRatio = 1.45;
/// A counter is stuck below this share of the distance in straight windows, of at least
/// kMinStraight_m in all.
constexpr double kStuckShare = 0.01;
constexpr double kMinStraight_m = 0.5;
/// Smallest correlation of the gyro with rotations of at least this rate; below it the gyro
/// measures another axis.
constexpr double kMinCorrelation = 0.2;
constexpr double kMinRotationRate_rad_s = 0.15;

/// Sums of wheels and gyro over a window, with its true motion.
struct WindowSums {
  double left_m = 0;
  double right_m = 0;
  double gyro_rad = 0;
  double duration_s = 0;
  bool has_gyro = true;
  double distance_m = 0;
  double rotation_rad = 0;
};

std::vector<WindowSums> sums_of(std::span<const DriveWindow> windows) {
  std::vector<WindowSums> sums;
  sums.reserve(windows.size());
  for (const DriveWindow& window : windows) {
    WindowSums sum;
    sum.distance_m = window.distance_m;
    sum.rotation_rad = window.rotation_rad;
    for (const core::OdometryIncrement& step : window.steps) {
      sum.left_m += step.left_m;
      sum.right_m += step.right_m;
      sum.gyro_rad += step.gyro_rad;
      sum.duration_s += step.duration_s();
      sum.has_gyro = sum.has_gyro && step.has_gyro;
    }
    sums.push_back(sum);
  }
  return sums;
}

/// y = share[0] x[0] + share[1] x[1].
struct Equation {
  Eigen::Vector2d x;
  double y = 0;
};

struct FactorPairEstimate {
  Eigen::Vector2d share = Eigen::Vector2d::Zero();
  Eigen::Vector2d sigma = Eigen::Vector2d::Zero();

  bool is_significant(int i) const { return std::abs(share[i]) > kMinSigmas * sigma[i]; }
  bool are_significant() const { return is_significant(0) && is_significant(1); }
  int sign(int i) const { return share[i] > 0 ? 1 : -1; }
};

/// Robust least squares with Cauchy weights scaled by the median residual. Nullopt where the
/// equations do not determine both shares.
std::optional<FactorPairEstimate> solve(const std::vector<Equation>& equations) {
  if (equations.size() < kMinEquations) return std::nullopt;
  std::vector<double> weights(equations.size(), 1);
  std::vector<double> residuals(equations.size());
  FactorPairEstimate shares;
  for (int round = 0; round < kReweightings; ++round) {
    Eigen::Matrix2d information = Eigen::Matrix2d::Zero();
    Eigen::Vector2d right = Eigen::Vector2d::Zero();
    for (std::size_t i = 0; i < equations.size(); ++i) {
      const Equation& equation = equations[i];
      information += weights[i] * equation.x * equation.x.transpose();
      right += weights[i] * equation.y * equation.x;
    }
    const double most = information.diagonal().prod();
    if (!(core::determinant(information) > 1e-9 * most)) return std::nullopt;
    const Eigen::Matrix2d covariance = core::inverse(information);
    shares.share = covariance * right;
    for (std::size_t i = 0; i < equations.size(); ++i) {
      residuals[i] = std::abs(equations[i].y - equations[i].x.dot(shares.share));
    }
    const double sigma = std::max(kMedianToSigma * median(residuals), 1e-9);
    for (std::size_t i = 0; i < equations.size(); ++i) {
      const double residual = residuals[i] / (2 * sigma);
      weights[i] = 1 / (1 + residual * residual);
    }
    shares.sigma = sigma * covariance.diagonal().cwiseSqrt();
  }
  return shares;
}

/// Shares of the left and right wheel in the translation, and in the rotation.
struct WheelFactors {
  FactorPairEstimate translation;
  FactorPairEstimate rotation;
};

std::optional<WheelFactors> wheel_factors(const std::vector<WindowSums>& sums) {
  std::vector<Equation> translations;
  std::vector<Equation> rotations;
  for (const WindowSums& sum : sums) {
    translations.push_back({{sum.left_m, sum.right_m}, sum.distance_m});
    rotations.push_back({{sum.left_m, sum.right_m}, sum.rotation_rad});
  }
  const auto translation = solve(translations);
  const auto rotation = solve(rotations);
  if (!translation || !rotation) return std::nullopt;
  if (!translation->are_significant() || !rotation->are_significant()) return std::nullopt;
  return WheelFactors{*translation, *rotation};
}

double track_of(const WheelFactors& wheels) {
  return 2 * wheels.translation.share.cwiseAbs().sum() / wheels.rotation.share.cwiseAbs().sum();
}

bool is_beyond_fit(double factor) { return factor < kMinScale || factor > kMaxScale; }

void find_stuck_counters(const std::vector<WindowSums>& sums, const core::DriveGeometry& geometry,
                         WiringFaults& faults) {
  double distance_m = 0;
  double left_m = 0;
  double right_m = 0;
  for (const WindowSums& sum : sums) {
    // On a curve one wheel may stand still.
    if (std::abs(sum.rotation_rad) * geometry.track_m > std::abs(sum.distance_m) / 4) continue;
    distance_m += std::abs(sum.distance_m);
    left_m += std::abs(sum.left_m);
    right_m += std::abs(sum.right_m);
  }
  if (distance_m < kMinStraight_m) return;
  faults.left_is_stuck = left_m < kStuckShare * distance_m;
  faults.right_is_stuck = right_m < kStuckShare * distance_m;
}

void find_wheel_faults(const WheelFactors& wheels, const core::DriveGeometry& geometry,
                       WiringFaults& faults) {
  const int left = wheels.translation.sign(0);
  const int right = wheels.translation.sign(1);
  const bool as_named = wheels.rotation.sign(0) == -left && wheels.rotation.sign(1) == right;
  const bool exchanged = wheels.rotation.sign(0) == left && wheels.rotation.sign(1) == -right;
  // Neither: such shares come from a wrong lidar mount, not from wheels.
  if (!as_named && !exchanged) return;
  faults.are_swapped = exchanged;
  faults.left_is_reversed = left < 0;
  faults.right_is_reversed = right < 0;

  // A lidar mount that is off to one side moves part of one wheel's translation share to the other.
  // Their sum is unaffected; wheels differ only where they do so in the rotation, too.
  const double sum = wheels.translation.share.cwiseAbs().sum();
  const double by_translation = std::abs(wheels.translation.share[0] / wheels.translation.share[1]);
  const double by_rotation = std::abs(wheels.rotation.share[0] / wheels.rotation.share[1]);
  const bool differ = std::min(by_translation, by_rotation) > kMaxRatio ||
                      std::max(by_translation, by_rotation) < 1 / kMaxRatio;
  const double ratio = differ ? by_rotation : 1;
  const double left_factor = 2 * sum * ratio / (1 + ratio);
  const double right_factor = 2 * sum / (1 + ratio);
  if (differ || is_beyond_fit(sum)) {
    faults.left_factor = left_factor;
    faults.right_factor = right_factor;
  }
  const double track_m = track_of(wheels);
  const double wider = track_m / geometry.track_m;
  if (wider > kMaxTrack || wider < 1 / kMaxTrack) faults.track_m = track_m;
}

/// By the correlation of the rates.
bool is_unrelated(const std::vector<Equation>& rotations) {
  const auto count = static_cast<double>(rotations.size());
  Eigen::Vector2d mean = Eigen::Vector2d::Zero();  // of the gyro, of the robot
  Eigen::Matrix2d square = Eigen::Matrix2d::Zero();
  for (const Equation& equation : rotations) {
    const Eigen::Vector2d rates = Eigen::Vector2d(equation.x[0], equation.y) / equation.x[1];
    mean += rates / count;
    square += rates * rates.transpose() / count;
  }
  const Eigen::Matrix2d covariance = square - mean * mean.transpose();
  if (covariance(1, 1) < kMinRotationRate_rad_s * kMinRotationRate_rad_s) return false;
  return covariance(0, 1) * covariance(0, 1) <
         kMinCorrelation * kMinCorrelation * covariance(0, 0) * covariance(1, 1);
}

void find_gyro_faults(const std::vector<WindowSums>& sums, WiringFaults& faults) {
  std::vector<Equation> rotations;
  for (const WindowSums& sum : sums) {
    if (sum.has_gyro) rotations.push_back({{sum.gyro_rad, sum.duration_s}, sum.rotation_rad});
  }
  const auto gyro = solve(rotations);
  if (!gyro) return;
  if (is_unrelated(rotations)) {
    faults.gyro_is_unrelated = true;
    return;
  }
  if (!gyro->is_significant(0)) return;
  const double share = std::abs(gyro->share[0]);
  faults.gyro_is_reversed = gyro->share[0] < 0;
  if (is_beyond_fit(share)) {
    faults.gyro_factor = 1 / share;
  } else if (const double bias_rad_s = -gyro->share[1] / gyro->share[0];
             std::abs(bias_rad_s) > kMaxBias_rad_s && gyro->is_significant(1)) {
    faults.gyro_bias_rad_s = bias_rad_s;
  }
}

}  // namespace

bool WiringFaults::any() const {
  return left_is_stuck || right_is_stuck || are_swapped || left_is_reversed || right_is_reversed ||
         left_factor || right_factor || track_m || gyro_is_unrelated || gyro_is_reversed ||
         gyro_factor || gyro_bias_rad_s;
}

WiringFaults find_wiring_faults(std::span<const DriveWindow> windows,
                                const core::DriveGeometry& geometry) {
  WiringFaults faults;
  const std::vector<WindowSums> sums = sums_of(windows);
  if (sums.size() < kMinEquations) return faults;
  find_stuck_counters(sums, geometry, faults);
  if (!faults.left_is_stuck && !faults.right_is_stuck) {
    if (const auto wheels = wheel_factors(sums)) find_wheel_faults(*wheels, geometry, faults);
  }
  find_gyro_faults(sums, faults);
  return faults;
}

std::optional<double> apparent_track_m(std::span<const DriveWindow> windows) {
  const auto wheels = wheel_factors(sums_of(windows));
  if (!wheels) return std::nullopt;
  return track_of(*wheels);
}

}  // namespace cornerd::calibration
