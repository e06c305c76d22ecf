// SPDX-License-Identifier: MIT
#include "calibration/odometry_fit.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

#include <Eigen/Cholesky>
#include <Eigen/Core>

namespace cornerd::calibration {
namespace {

using core::MotionStep;

constexpr std::size_t kFewestWindows = 10;
constexpr int kRounds = 8;
/// What two places and a second of wheels and gyro are off by.
constexpr double kPlaceSigma_m = 0.004;
constexpr double kWheelTurnSigma_rad = 0.015;
constexpr double kGyroTurnSigma_rad = 0.003;
/// Cauchy: a residual of so many sigmas counts half; one of a slip hardly at all.
constexpr double kHalfWeightSigmas = 2;
/// Without a prior as wide as this a drive that does not turn would have no solution at all.
constexpr double kPriorScale = 0.3;
constexpr double kPriorBias_rad_s = 0.3;
/// A drive tells a scale when it is left this unsure.
constexpr double kMostSigma = 0.05;

enum Parameter : std::uint8_t { kBias, kLeft, kRight, kTrack, kGyro, kParameters };
using Vector = Eigen::Matrix<double, kParameters, 1>;
using Matrix = Eigen::Matrix<double, kParameters, kParameters>;

core::LearnedOdometry as_learned(const Vector& p) {
  return {p[kBias], p[kLeft], p[kRight], p[kTrack], p[kGyro]};
}

/// Turn and way of a step with what was learned.
struct Moved {
  double way_m = 0;
  double wheel_turn_rad = 0;
  double turn_rad = 0;
};
Moved moved_by(const MotionStep& step, const core::DriveGeometry& geometry,
               const core::LearnedOdometry& learned) {
  const double left_m = step.left_m * (1 + learned.left_scale);
  const double right_m = step.right_m * (1 + learned.right_scale);
  Moved moved;
  moved.way_m = (left_m + right_m) / 2;
  moved.wheel_turn_rad = (right_m - left_m) / (geometry.track_m * (1 + learned.track_scale));
  moved.turn_rad = step.has_gyro ? (step.gyro_rad - learned.gyro_bias_rad_s * step.duration_s()) /
                                       (1 + learned.gyro_scale)
                                 : moved.wheel_turn_rad;
  return moved;
}

/// Walks through the steps, and looks at each known place where the robot has got to. `prepare` has
/// whole steps, `motion` those parts of them that lie between two places.
template <typename Prepare, typename Motion>
DriveError walk(std::span<const MotionStep> steps, std::span<const KnownPlace> places,
                DrivePoints* points, const Prepare& prepare, const Motion& motion) {
  DriveError error;
  std::size_t next = 0;
  while (next < places.size() && !steps.empty() && places[next].t_ns < steps.front().from_ns) {
    ++next;
  }
  if (next == places.size()) return error;
  core::Pose2 T_map_base = places[next].T_map_base;
  core::TimeNs now_ns = places[next].t_ns;
  ++next;
  for (const MotionStep& step : steps) {
    if (step.to_ns <= now_ns) continue;
    MotionStep rest = prepare(step);
    if (rest.from_ns < now_ns) rest.split(now_ns);
    while (next < places.size() && places[next].t_ns <= rest.to_ns) {
      if (places[next].t_ns > rest.from_ns && places[next].t_ns < rest.to_ns) {
        T_map_base = T_map_base * motion(rest.split(places[next].t_ns));
      } else if (places[next].t_ns == rest.to_ns) {
        break;
      }
      error.end_m = (T_map_base.translation() - places[next].T_map_base.translation()).norm();
      error.mean_m += error.end_m;
      if (points != nullptr) points->push_back(T_map_base.translation());
      ++error.places;
      ++next;
    }
    T_map_base = T_map_base * motion(rest);
    now_ns = rest.to_ns;
  }
  if (error.places > 0) error.mean_m /= static_cast<double>(error.places);
  return error;
}

constexpr int kResiduals = 4;
using Residuals = Eigen::Matrix<double, kResiduals, 1>;

/// In sigmas: the way's two parts, the turn by the wheels, the turn by the gyro.
Residuals residuals_of(const DriveWindow& window, const core::DriveGeometry& geometry,
                       const Vector& p) {
  const core::LearnedOdometry learned = as_learned(p);
  core::Pose2 way;
  double wheel_turn_rad = 0;
  double turn_rad = 0;
  bool has_gyro = true;
  for (const MotionStep& step : window.steps) {
    const Moved moved = moved_by(step, geometry, learned);
    way = way * core::arc(moved.way_m, moved.turn_rad);
    wheel_turn_rad += moved.wheel_turn_rad;
    turn_rad += moved.turn_rad;
    has_gyro = has_gyro && step.has_gyro;
  }
  return {(way.x_m - window.way.x_m) / kPlaceSigma_m, (way.y_m - window.way.y_m) / kPlaceSigma_m,
          (wheel_turn_rad - window.turn_rad) / kWheelTurnSigma_rad,
          has_gyro ? (turn_rad - window.turn_rad) / kGyroTurnSigma_rad : 0};
}

}  // namespace

DriveError reckon(std::span<const MotionStep> steps, std::span<const KnownPlace> places,
                  const core::DriveGeometry& geometry, const core::DeadReckoningConfig& config,
                  DrivePoints* points) {
  // A dead band is for whole steps: parts of them would stay under it.
  return walk(
      steps, places, points,
      [&](const MotionStep& step) { return core::by_wheels_alone(step, geometry, config); },
      [&](const MotionStep& alone) {
        return core::arc(alone.way_m(), (alone.right_m - alone.left_m) / geometry.track_m);
      });
}

DriveError reckon(std::span<const MotionStep> steps, std::span<const KnownPlace> places,
                  const core::DriveGeometry& geometry, const core::LearnedOdometry& learned,
                  DrivePoints* points) {
  return walk(steps, places, points, std::identity(), [&](const MotionStep& step) {
    const Moved moved = moved_by(step, geometry, learned);
    return core::arc(moved.way_m, moved.turn_rad);
  });
}

std::optional<OdometryFit> fit_odometry(std::span<const MotionStep> steps,
                                        std::span<const KnownPlace> places,
                                        const core::DriveGeometry& geometry) {
  const std::vector<DriveWindow> windows = cut_windows(steps, places);
  if (windows.size() < kFewestWindows) return std::nullopt;
  OdometryFit fit;
  fit.windows = windows.size();
  fit.has_gyro = std::any_of(windows.begin(), windows.end(), [](const DriveWindow& window) {
    return window.steps.front().has_gyro;
  });
  Vector p = Vector::Zero();
  Matrix information;
  Eigen::LDLT<Matrix> solver;
  for (int round = 0; round < kRounds; ++round) {
    information.setZero();
    Vector gradient = Vector::Zero();
    for (int i = 0; i < kParameters; ++i) {
      const double sigma = i == kBias ? kPriorBias_rad_s : kPriorScale;
      information(i, i) = 1 / (sigma * sigma);
      gradient[i] = p[i] / (sigma * sigma);
    }
    for (const DriveWindow& window : windows) {
      const Residuals now = residuals_of(window, geometry, p);
      Eigen::Matrix<double, kResiduals, kParameters> slope;
      constexpr double kNudge = 1e-5;
      for (int i = 0; i < kParameters; ++i) {
        Vector nudged = p;
        nudged[i] += kNudge;
        slope.col(i) = (residuals_of(window, geometry, nudged) - now) / kNudge;
      }
      const Residuals weight = now.unaryExpr(
          [](double r) { return 1 / (1 + r * r / (kHalfWeightSigmas * kHalfWeightSigmas)); });
      information += slope.transpose() * weight.asDiagonal() * slope;
      gradient += slope.transpose() * weight.cwiseProduct(now);
    }
    solver.compute(information);
    p -= solver.solve(gradient);
    p = p.cwiseMax(-kMostFittedScale).cwiseMin(kMostFittedScale);
  }
  const Matrix covariance = solver.solve(Matrix::Identity());
  if (!p.allFinite() || !covariance.allFinite()) return std::nullopt;
  const Vector sigma = covariance.diagonal().cwiseMax(0).cwiseSqrt();
  for (const int i : {kLeft, kRight, kTrack}) {
    if (sigma[i] > kMostSigma) return std::nullopt;
  }
  if (fit.has_gyro && sigma[kGyro] > kMostSigma) return std::nullopt;
  fit.learned = as_learned(p);
  fit.sigma = as_learned(sigma);
  return fit;
}

}  // namespace cornerd::calibration
