// SPDX-License-Identifier: MIT
#include "calibration/wiring_faults.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include <Eigen/Core>
#include <Eigen/LU>

#include "calibration/odometry_fit.hpp"
#include "calibration/robust_statistics.hpp"

namespace cornerd::calibration {
namespace {

constexpr std::size_t kFewestTold = 10;
constexpr int kReweightings = 20;
/// A share that is fewer sigmas from none has no sign that is known. Slips spoil whole windows, and
/// what is said here is to be true.
constexpr double kSureSigmas = 8;
/// Nearer to once than these the fit finds a scale, or a track, itself.
constexpr double kMinScale = 0.6;
constexpr double kMaxScale = 1.45;
constexpr double kMaxTrack = 2.2;
/// The fit's own bound, less what its prior takes.
constexpr double kMaxBias_rad_s = 0.9 * kMaxFittedScale;
/// Wheels of one robot that differ by more are not of one make.
constexpr double kMaxUnlike = 1.45;
/// A wheel that stands, as a share of the way of straight windows, of which there are so many
/// metres.
constexpr double kStandingShare = 0.01;
constexpr double kStraights_m = 0.5;
/// A gyro that has less to do with turns as fast as this is that of another axis.
constexpr double kUnrelated = 0.2;
constexpr double kMinRotationRate_rad_s = 0.15;

/// What wheels and gyro say of a window, and what it was.
struct Told {
  double left_m = 0;
  double right_m = 0;
  double gyro_rad = 0;
  double duration_s = 0;
  bool has_gyro = true;
  double way_m = 0;
  double rotation_rad = 0;
};

std::vector<Told> sums_of(std::span<const DriveWindow> windows) {
  std::vector<Told> sums;
  sums.reserve(windows.size());
  for (const DriveWindow& window : windows) {
    Told told;
    told.way_m = window.way_m;
    told.rotation_rad = window.rotation_rad;
    for (const core::OdometryIncrement& step : window.steps) {
      told.left_m += step.left_m;
      told.right_m += step.right_m;
      told.gyro_rad += step.gyro_rad;
      told.duration_s += step.duration_s();
      told.has_gyro = told.has_gyro && step.has_gyro;
    }
    sums.push_back(told);
  }
  return sums;
}

/// y = share[0] x[0] + share[1] x[1].
struct Equation {
  Eigen::Vector2d x;
  double y = 0;
};

struct Shares {
  Eigen::Vector2d share = Eigen::Vector2d::Zero();
  Eigen::Vector2d sigma = Eigen::Vector2d::Zero();

  bool is_sure(int i) const { return std::abs(share[i]) > kSureSigmas * sigma[i]; }
  bool are_sure() const { return is_sure(0) && is_sure(1); }
  int sign(int i) const { return share[i] > 0 ? 1 : -1; }
};

/// Cauchy's weights, their width from the median: a slip's window counts hardly at all. Nullopt
/// where the equations do not tell both shares.
std::optional<Shares> solve(const std::vector<Equation>& equations) {
  if (equations.size() < kFewestTold) return std::nullopt;
  std::vector<double> weights(equations.size(), 1);
  std::vector<double> residuals(equations.size());
  Shares shares;
  for (int round = 0; round < kReweightings; ++round) {
    Eigen::Matrix2d information = Eigen::Matrix2d::Zero();
    Eigen::Vector2d right = Eigen::Vector2d::Zero();
    for (std::size_t i = 0; i < equations.size(); ++i) {
      const Equation& equation = equations[i];
      information += weights[i] * equation.x * equation.x.transpose();
      right += weights[i] * equation.y * equation.x;
    }
    const double most = information.diagonal().prod();
    if (!(information.determinant() > 1e-9 * most)) return std::nullopt;
    const Eigen::Matrix2d covariance = information.inverse();
    shares.share = covariance * right;
    for (std::size_t i = 0; i < equations.size(); ++i) {
      residuals[i] = std::abs(equations[i].y - equations[i].x.dot(shares.share));
    }
    const double sigma = std::max(kMedianToSigma * median(residuals), 1e-9);
    for (std::size_t i = 0; i < equations.size(); ++i) {
      const double surprise = residuals[i] / (2 * sigma);
      weights[i] = 1 / (1 + surprise * surprise);
    }
    shares.sigma = sigma * covariance.diagonal().cwiseSqrt();
  }
  return shares;
}

/// The shares of left and right in the way, and in the turn.
struct WheelShares {
  Shares way;
  Shares scan;
};

std::optional<WheelShares> wheel_shares(const std::vector<Told>& sums) {
  std::vector<Equation> ways;
  std::vector<Equation> scans;
  for (const Told& told : sums) {
    ways.push_back({{told.left_m, told.right_m}, told.way_m});
    scans.push_back({{told.left_m, told.right_m}, told.rotation_rad});
  }
  const auto way = solve(ways);
  const auto scan = solve(scans);
  if (!way || !scan || !way->are_sure() || !scan->are_sure()) return std::nullopt;
  return WheelShares{*way, *scan};
}

double track_of(const WheelShares& wheels) {
  return 2 * wheels.way.share.cwiseAbs().sum() / wheels.scan.share.cwiseAbs().sum();
}

bool is_far(double factor) { return factor < kMinScale || factor > kMaxScale; }

void find_standing(const std::vector<Told>& sums, const core::DriveGeometry& geometry,
                   WiringFaults& faults) {
  double way_m = 0;
  double left_m = 0;
  double right_m = 0;
  for (const Told& told : sums) {
    // On a curve one of them may stand.
    if (std::abs(told.rotation_rad) * geometry.track_m > std::abs(told.way_m) / 4) continue;
    way_m += std::abs(told.way_m);
    left_m += std::abs(told.left_m);
    right_m += std::abs(told.right_m);
  }
  if (way_m < kStraights_m) return;
  faults.left_is_stuck = left_m < kStandingShare * way_m;
  faults.right_is_stuck = right_m < kStandingShare * way_m;
}

void find_wheel_faults(const WheelShares& wheels, const core::DriveGeometry& geometry,
                       WiringFaults& faults) {
  const int left = wheels.way.sign(0);
  const int right = wheels.way.sign(1);
  const bool as_named = wheels.scan.sign(0) == -left && wheels.scan.sign(1) == right;
  const bool exchanged = wheels.scan.sign(0) == left && wheels.scan.sign(1) == -right;
  // Neither: a lidar's mount that is wrong gives such shares, no wheel does.
  if (!as_named && !exchanged) return;
  faults.are_swapped = exchanged;
  faults.left_is_reversed = left < 0;
  faults.right_is_reversed = right < 0;

  // A mount that is off to one side takes from one wheel's share of the way what it gives to the
  // other's: what both say is right of the sum, and unlike are wheels that are so in the turn, too.
  const double sum = wheels.way.share.cwiseAbs().sum();
  const double by_way = std::abs(wheels.way.share[0] / wheels.way.share[1]);
  const double by_turn = std::abs(wheels.scan.share[0] / wheels.scan.share[1]);
  const bool are_unlike =
      std::min(by_way, by_turn) > kMaxUnlike || std::max(by_way, by_turn) < 1 / kMaxUnlike;
  const double unlike = are_unlike ? by_turn : 1;
  const double left_factor = 2 * sum * unlike / (1 + unlike);
  const double right_factor = 2 * sum / (1 + unlike);
  if (are_unlike || is_far(sum)) {
    faults.left_factor = left_factor;
    faults.right_factor = right_factor;
  }
  const double track_m = track_of(wheels);
  const double wider = track_m / geometry.track_m;
  if (wider > kMaxTrack || wider < 1 / kMaxTrack) faults.track_m = track_m;
}

/// By the correlation of the rates.
bool is_unrelated(const std::vector<Equation>& scans) {
  const auto count = static_cast<double>(scans.size());
  Eigen::Vector2d mean = Eigen::Vector2d::Zero();  // of the gyro, of the robot
  Eigen::Matrix2d square = Eigen::Matrix2d::Zero();
  for (const Equation& scan : scans) {
    const Eigen::Vector2d rates = Eigen::Vector2d(scan.x[0], scan.y) / scan.x[1];
    mean += rates / count;
    square += rates * rates.transpose() / count;
  }
  const Eigen::Matrix2d covariance = square - mean * mean.transpose();
  if (covariance(1, 1) < kMinRotationRate_rad_s * kMinRotationRate_rad_s) return false;
  return covariance(0, 1) * covariance(0, 1) <
         kUnrelated * kUnrelated * covariance(0, 0) * covariance(1, 1);
}

void find_gyro_faults(const std::vector<Told>& sums, WiringFaults& faults) {
  std::vector<Equation> scans;
  for (const Told& told : sums) {
    if (told.has_gyro) scans.push_back({{told.gyro_rad, told.duration_s}, told.rotation_rad});
  }
  const auto gyro = solve(scans);
  if (!gyro) return;
  if (is_unrelated(scans)) {
    faults.gyro_is_unrelated = true;
    return;
  }
  if (!gyro->is_sure(0)) return;
  const double share = std::abs(gyro->share[0]);
  faults.gyro_is_reversed = gyro->share[0] < 0;
  if (is_far(share)) {
    faults.gyro_factor = 1 / share;
  } else if (const double bias_rad_s = -gyro->share[1] / gyro->share[0];
             std::abs(bias_rad_s) > kMaxBias_rad_s && gyro->is_sure(1)) {
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
  const std::vector<Told> sums = sums_of(windows);
  if (sums.size() < kFewestTold) return faults;
  find_standing(sums, geometry, faults);
  if (!faults.left_is_stuck && !faults.right_is_stuck) {
    if (const auto wheels = wheel_shares(sums)) find_wheel_faults(*wheels, geometry, faults);
  }
  find_gyro_faults(sums, faults);
  return faults;
}

std::optional<double> apparent_track_m(std::span<const DriveWindow> windows) {
  const auto wheels = wheel_shares(sums_of(windows));
  if (!wheels) return std::nullopt;
  return track_of(*wheels);
}

}  // namespace cornerd::calibration
