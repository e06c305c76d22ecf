// SPDX-License-Identifier: MIT
#include "calibration/odometry_fit.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <Eigen/LU>

#include "calibration/delay_search.hpp"
#include "calibration/robust_statistics.hpp"
#include "core/geometry/squared.hpp"
#include "core/odometry/motion_factor.hpp"

namespace cornerd::calibration {
namespace {

using core::OdometryIncrement;

constexpr std::size_t kMinWindows = 10;
constexpr int kRounds = 10;
/// Sigmas of a wide prior, which regularises drives without rotation.
constexpr double kPriorScale = 0.3;
constexpr double kPriorBias_rad_s = 0.3;
constexpr double kPriorDelay_s = 0.3;
/// Largest sigma of a scale that the drive determines.
constexpr double kMaxSigma = 0.05;
/// The same of the delay: a tenth of a scan.
constexpr double kMaxDelaySigma_s = 0.015;
/// Lags of the Newey-West covariance: adjacent windows share a pose, and slips may last.
constexpr std::size_t kLags = 4;
/// A window without a gyro says nothing of one.
constexpr double kNoGyroSigma_rad = 1e9;
/// Unmodelled errors, added to the sigmas: speeds that change between readings, a gyro lag of a
/// millisecond (from simulated drives).
constexpr double kUnmodelled = 2e-4;
constexpr double kUnmodelledBias_rad_s = 3e-5;
constexpr double kUnmodelledDelay_s = 4e-4;
/// Rounds with Cauchy weights, before Tukey weights at the residuals' own scale, and its bound.
constexpr int kCauchyRounds = 3;
constexpr double kMinScaleFactor = 0.1;
/// Share of the unweighted information of each parameter that the weights must keep.
constexpr double kMinKeptInformation = 0.5;

enum Parameter : std::uint8_t { kBias, kLeft, kRight, kTrack, kGyro, kDelay, kParameters };
using Vector = Eigen::Matrix<double, kParameters, 1>;
using Matrix = Eigen::Matrix<double, kParameters, kParameters>;

core::OdometryParameters as_learned(const Vector& p) {
  return {p[kBias], p[kLeft], p[kRight], p[kTrack], p[kGyro], p[kDelay]};
}

constexpr int kResiduals = 4;
using Residuals = Eigen::Matrix<double, kResiduals, 1>;

/// In sigmas: x, y, rotation by the wheels, rotation by the gyro.
struct WindowResiduals {
  Residuals values;
  Eigen::Matrix<double, kResiduals, kParameters> slope;
  /// Extra variance from a rate that changes between two readings at an unknown time.
  Residuals interpolation;
};

WindowResiduals residuals_of(const DriveWindow& window, const core::DriveGeometry& geometry,
                             const Vector& p) {
  using core::MotionFactor;
  MotionFactor factor(geometry, as_learned(p));
  for (const OdometryIncrement& step : window.steps) factor.add(step);
  const core::Pose2 motion = factor.motion();
  // Scaled to a fixed track: a wider estimate would otherwise shrink the residuals.
  const double track = 1 + p[kTrack];
  const Residuals off(motion.x_m - window.motion.x_m, motion.y_m - window.motion.y_m,
                      factor.wheel_rotation_rad() - window.rotation_rad,
                      factor.rotation_rad() - window.rotation_rad);
  const double gyro_sigma_rad = factor.has_gyro() ? kGyroRotationSigma_rad : kNoGyroSigma_rad;
  const Residuals unit(1 / kPoseSigma_m, 1 / kPoseSigma_m, track / kWheelRotationSigma_rad,
                       1 / gyro_sigma_rad);
  constexpr int kRowsInOrder[] = {0, 1, 3, 2};
  WindowResiduals of{unit.cwiseProduct(off), {}, {}};
  for (int i = 0; i < kResiduals; ++i) {
    const int row = kRowsInOrder[i];
    of.slope.row(i) << unit[i] * factor.jacobian().row(row).head<kDelay>(),
        unit[i] * factor.delay_slope()[row];
    of.interpolation[i] = core::squared(unit[i]) * factor.covariance()(row, row);
  }
  of.slope(2, kTrack) += off[2] / kWheelRotationSigma_rad;
  return of;
}

/// Iteratively reweighted least squares over the windows.
class Fit {
 public:
  Fit(std::span<const OdometryIncrement> steps, std::span<const KnownPose> places,
      const core::DriveGeometry& geometry, double delay_s)
      : steps_(steps), places_(places), geometry_(geometry), start_s_(delay_s) {
    p_[kDelay] = delay_s;
    prior_ = Vector::Constant(1 / core::squared(kPriorScale));
    prior_[kBias] = 1 / core::squared(kPriorBias_rad_s);
    prior_[kDelay] = 1 / core::squared(kPriorDelay_s);
  }

  /// False where the drive is too short.
  bool run(bool with_delay) {
    with_delay_ = with_delay;
    return run_once(/*with_tukey=*/true) && (keeps_information() || run_once(/*with_tukey=*/false));
  }

  const Vector& parameters() const { return p_; }
  std::size_t windows() const { return window_gradients_.size(); }
  bool has_gyro() const { return has_gyro_; }

  Vector sigma() const {
    Vector unmodelled = Vector::Constant(core::squared(kUnmodelled));
    unmodelled[kBias] = core::squared(kUnmodelledBias_rad_s);
    unmodelled[kDelay] = core::squared(kUnmodelledDelay_s);
    return (covariance().diagonal().cwiseMax(0) + unmodelled).cwiseSqrt();
  }

  /// Sigmas without the effect of model errors.
  Vector least_sigma() const { return information_.inverse().diagonal().cwiseMax(0).cwiseSqrt(); }

 private:
  /// Huber's sandwich covariance of the actual residuals, with Newey-West terms for the correlation
  /// of adjacent windows.
  Matrix covariance() const {
    Matrix meat = prior_.asDiagonal();
    for (std::size_t lag = 0; lag <= kLags; ++lag) {
      const double weight = 1 - static_cast<double>(lag) / (kLags + 1);
      for (std::size_t i = lag; i < window_gradients_.size(); ++i) {
        const Matrix both = window_gradients_[i] * window_gradients_[i - lag].transpose();
        meat += lag == 0 ? both : Matrix(weight * (both + both.transpose()));
      }
    }
    const Eigen::LDLT<Matrix> factorized(curvature_);
    const bool is_convex =
        factorized.info() == Eigen::Success && factorized.vectorD().minCoeff() > 0;
    const Matrix inverse =
        is_convex ? Matrix(factorized.solve(Matrix::Identity())) : Matrix(information_.inverse());
    return inverse * meat * inverse;
  }

  bool run_once(bool with_tukey) {
    p_ = Vector::Zero();
    p_[kDelay] = start_s_;
    scale_ = Residuals::Ones();
    uses_tukey_ = false;
    for (int round = 0; round < kRounds; ++round) {
      if (!linearize()) return false;
      if (with_tukey && (round == kCauchyRounds || round == 2 * kCauchyRounds)) measure();
      p_ -= information_.ldlt().solve(gradient_);
      const double delay_s = with_delay_ ? p_[kDelay] : start_s_;
      p_ = p_.cwiseMax(-kMaxFittedScale).cwiseMin(kMaxFittedScale);
      p_[kDelay] = std::clamp(delay_s, -kMaxDelay_s, kMaxDelay_s);
    }
    return linearize() && p_.allFinite();
  }

  /// False for tracks that slip in every rotation: Tukey weights would remove all rotations.
  bool keeps_information() const {
    const Vector kept = information_.diagonal() - prior_;
    return (kept.array() >= kMinKeptInformation * unweighted_.array()).all();
  }

  bool linearize() {
    const std::vector<DriveWindow> windows =
        cut_windows(at_true_times(steps_, p_[kDelay]), places_);
    if (windows.size() < kMinWindows) return false;
    information_ = prior_.asDiagonal();
    curvature_ = prior_.asDiagonal();
    Vector from_prior = p_;
    from_prior[kDelay] -= start_s_;
    gradient_ = prior_.cwiseProduct(from_prior);
    unweighted_.setZero();
    window_gradients_.clear();
    residuals_.clear();
    has_gyro_ = false;
    for (const DriveWindow& window : windows) add(window);
    return true;
  }

  /// Scales of the residuals by their medians, which occasional slips do not affect.
  void measure() {
    uses_tukey_ = true;
    for (int kind = 0; kind < kResiduals; ++kind) {
      std::vector<double> sizes;
      for (const Residuals& residuals : residuals_) sizes.push_back(std::abs(residuals[kind]));
      scale_[kind] = std::max(kMedianToSigma * median(std::move(sizes)), kMinScaleFactor);
    }
  }

  void add(const DriveWindow& window) {
    const WindowResiduals of = residuals_of(window, geometry_, p_);
    const Residuals sigma = (scale_.cwiseAbs2() + of.interpolation).cwiseSqrt();
    const Residuals now = of.values.cwiseQuotient(sigma);
    residuals_.push_back(of.values);
    Eigen::Matrix<double, kResiduals, kParameters> slope =
        sigma.cwiseInverse().asDiagonal() * of.slope;
    if (!with_delay_) slope.col(kDelay).setZero();
    const Residuals weight =
        now.unaryExpr([&](double r) { return uses_tukey_ ? tukey_weight(r) : cauchy_weight(r); });
    const Residuals curve = now.unaryExpr(
        [&](double r) { return uses_tukey_ ? tukey_curvature(r) : cauchy_curvature(r); });
    unweighted_ += slope.cwiseAbs2().colwise().sum().transpose();
    information_ += slope.transpose() * weight.asDiagonal() * slope;
    curvature_ += slope.transpose() * curve.asDiagonal() * slope;
    window_gradients_.push_back(slope.transpose() * weight.cwiseProduct(now));
    gradient_ += window_gradients_.back();
    has_gyro_ = has_gyro_ || window.steps.front().has_gyro;
  }

  std::span<const OdometryIncrement> steps_;
  std::span<const KnownPose> places_;
  core::DriveGeometry geometry_;
  double start_s_;
  bool with_delay_ = true;
  bool uses_tukey_ = false;
  bool has_gyro_ = false;
  Vector p_ = Vector::Zero();
  Vector prior_;  ///< its information
  Matrix information_;
  Vector unweighted_;  ///< diagonal of the information with equal weights
  Matrix curvature_;
  Vector gradient_;
  Residuals scale_ = Residuals::Ones();   ///< actual over modelled sigma
  std::vector<Residuals> residuals_;      ///< of each window, in modelled sigmas
  std::vector<Vector> window_gradients_;  ///< of each window
};

}  // namespace

std::optional<OdometryFit> fit_odometry(std::span<const OdometryIncrement> steps,
                                        std::span<const KnownPose> places,
                                        const core::DriveGeometry& geometry, double delay_s) {
  Fit fit(steps, places, geometry, delay_s);
  if (!fit.run(/*with_delay=*/true)) return std::nullopt;
  OdometryFit found;
  Vector sigma = fit.sigma();
  found.has_delay = sigma[kDelay] < kMaxDelaySigma_s;
  if (!found.has_delay) {
    const double delay_sigma_s = sigma[kDelay];
    if (!fit.run(/*with_delay=*/false)) return std::nullopt;
    sigma = fit.sigma();
    sigma[kDelay] = delay_sigma_s;
  }
  if (!sigma.allFinite()) return std::nullopt;
  const Vector least = fit.least_sigma();
  found.windows = fit.windows();
  found.has_gyro = fit.has_gyro();
  for (const int i : {kLeft, kRight, kTrack}) {
    if (least[i] > kMaxSigma) return std::nullopt;
  }
  if (found.has_gyro && least[kGyro] > kMaxSigma) return std::nullopt;
  found.learned = as_learned(fit.parameters());
  found.sigma = as_learned(sigma);
  return found;
}

}  // namespace cornerd::calibration
