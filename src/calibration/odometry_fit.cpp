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
#include "core/odometry/corrected_increment.hpp"

namespace cornerd::calibration {
namespace {

using core::OdometryIncrement;

constexpr std::size_t kFewestWindows = 10;
constexpr int kRounds = 10;
/// Without a prior as wide as this a drive that does not turn would have no solution at all.
constexpr double kPriorScale = 0.3;
constexpr double kPriorBias_rad_s = 0.3;
constexpr double kPriorDelay_s = 0.3;
/// A drive tells a scale when it is left this unsure.
constexpr double kMaxSigma = 0.05;
/// The same of the delay: a tenth of a turn of the lidar.
constexpr double kMaxDelaySigma_s = 0.015;
/// Neighbours share a place, and a slip or a place that is off may last.
constexpr std::size_t kTogether = 4;
/// To either side, for the slope: about a reading.
constexpr double kDelayNudge_s = 0.005;
/// What no window tells of its own: speeds that change between two readings, a gyro that lags
/// behind the wheels by a millisecond (simulated drives against what they were made with).
constexpr double kUntold = 2e-4;
constexpr double kUntoldBias_rad_s = 3e-5;
constexpr double kUntoldDelay_s = 4e-4;
/// Rounds after which residuals are told in what they are, and no longer in what they should be;
/// and bounds of that.
constexpr int kRoughRounds = 3;
constexpr double kMinUnit = 0.1;
/// Of what the windows tell of anything, so much has to weigh.
constexpr double kMinKept = 0.5;

enum Parameter : std::uint8_t { kBias, kLeft, kRight, kTrack, kGyro, kDelay, kParameters };
using Vector = Eigen::Matrix<double, kParameters, 1>;
using Matrix = Eigen::Matrix<double, kParameters, kParameters>;

core::OdometryParameters as_learned(const Vector& p) {
  return {p[kBias], p[kLeft], p[kRight], p[kTrack], p[kGyro], p[kDelay]};
}

constexpr int kResiduals = 4;
using Residuals = Eigen::Matrix<double, kResiduals, 1>;

/// In sigmas: the way's two parts, the turn by the wheels, the turn by the gyro.
Residuals residuals_of(const DriveWindow& window, const core::DriveGeometry& geometry,
                       const Vector& p) {
  const core::OdometryParameters learned = as_learned(p);
  core::Pose2 way;
  double wheel_rotation_rad = 0;
  double rotation_rad = 0;
  bool has_gyro = true;
  for (const OdometryIncrement& step : window.steps) {
    const core::CorrectedIncrement moved = core::corrected_increment(step, geometry, learned);
    way = way * core::arc(moved.translation_m, moved.rotation_rad);
    wheel_rotation_rad += moved.wheel_rotation_rad;
    rotation_rad += moved.rotation_rad;
    has_gyro = has_gyro && step.has_gyro;
  }
  // Not by the track that is looked for: a wider one would make all that wheels wander smaller.
  const double track = 1 + learned.track_scale;
  return {(way.x_m - window.way.x_m) / kPlaceSigma_m, (way.y_m - window.way.y_m) / kPlaceSigma_m,
          track * (wheel_rotation_rad - window.rotation_rad) / kWheelRotationSigma_rad,
          has_gyro ? (rotation_rad - window.rotation_rad) / kGyroRotationSigma_rad : 0};
}

/// In sigmas, what a gyro's rate that changes between two readings may make of the window: a robot
/// that starts to turn at once did so at any time between them.
Residuals unevenness_of(const DriveWindow& window) {
  double change_rad2 = 0;
  for (const OdometryIncrement& step : window.steps) {
    change_rad2 += core::squared(step.gyro_change_rad) / 3;
  }
  const double change_rad = std::sqrt(change_rad2);
  const double aside_m = change_rad * std::abs(window.way_m) / 2;
  return {aside_m / kPlaceSigma_m, aside_m / kPlaceSigma_m, 0, change_rad / kGyroRotationSigma_rad};
}

/// The drive at the delay that is tried, and what is asked of it.
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
    return run_once(/*sharpens=*/true) && (tells_enough() || run_once(/*sharpens=*/false));
  }

  const Vector& parameters() const { return p_; }
  std::size_t windows() const { return pulls_.size(); }
  bool has_gyro() const { return has_gyro_; }

  Vector sigma() const {
    Vector untold = Vector::Constant(core::squared(kUntold));
    untold[kBias] = core::squared(kUntoldBias_rad_s);
    untold[kDelay] = core::squared(kUntoldDelay_s);
    return (covariance().diagonal().cwiseMax(0) + untold).cwiseSqrt();
  }

  /// What the drive tells of each if nothing is amiss with it.
  Vector least_sigma() const { return information_.inverse().diagonal().cwiseMax(0).cwiseSqrt(); }

 private:
  /// Huber's, of what the residuals are and not of what they should be (the "sandwich"); what
  /// neighbours have in common counts as Newey and West have it.
  Matrix covariance() const {
    Matrix together = prior_.asDiagonal();
    for (std::size_t lag = 0; lag <= kTogether; ++lag) {
      const double weight = 1 - static_cast<double>(lag) / (kTogether + 1);
      for (std::size_t i = lag; i < pulls_.size(); ++i) {
        const Matrix both = pulls_[i] * pulls_[i - lag].transpose();
        together += lag == 0 ? both : Matrix(weight * (both + both.transpose()));
      }
    }
    const Eigen::LDLT<Matrix> curved(curvature_);
    const bool is_bowl = curved.info() == Eigen::Success && curved.vectorD().minCoeff() > 0;
    const Matrix inverse =
        is_bowl ? Matrix(curved.solve(Matrix::Identity())) : Matrix(information_.inverse());
    return inverse * together * inverse;
  }

  bool run_once(bool sharpens) {
    p_ = Vector::Zero();
    p_[kDelay] = start_s_;
    unit_ = Residuals::Ones();
    is_sharp_ = false;
    for (int round = 0; round < kRounds; ++round) {
      if (!linearize()) return false;
      if (sharpens && (round == kRoughRounds || round == 2 * kRoughRounds)) measure();
      p_ -= information_.ldlt().solve(gradient_);
      const double delay_s = with_delay_ ? p_[kDelay] : start_s_;
      p_ = p_.cwiseMax(-kMaxFittedScale).cwiseMin(kMaxFittedScale);
      p_[kDelay] = std::clamp(delay_s, -kMaxDelay_s, kMaxDelay_s);
    }
    return linearize() && p_.allFinite();
  }

  /// Tracks that slip whenever they turn are no robot that slips now and then: what is left without
  /// their turns would not tell of turns at all.
  bool tells_enough() const {
    const Vector kept = information_.diagonal() - prior_;
    return (kept.array() >= kMinKept * unweighted_.array()).all();
  }

  bool linearize() {
    const auto cut = [&](double delay_s) {
      return cut_windows(at_true_times(steps_, delay_s), places_);
    };
    const std::vector<DriveWindow> windows = cut(p_[kDelay]);
    if (windows.size() < kFewestWindows) return false;
    const std::vector<DriveWindow> earlier =
        with_delay_ ? cut(p_[kDelay] - kDelayNudge_s) : windows;
    const std::vector<DriveWindow> later = with_delay_ ? cut(p_[kDelay] + kDelayNudge_s) : windows;
    information_ = prior_.asDiagonal();
    curvature_ = prior_.asDiagonal();
    Vector from_prior = p_;
    from_prior[kDelay] -= start_s_;
    gradient_ = prior_.cwiseProduct(from_prior);
    unweighted_.setZero();
    pulls_.clear();
    residuals_.clear();
    has_gyro_ = false;
    for (const DriveWindow& window : windows) {
      const DriveWindow* before = same(earlier, window);
      const DriveWindow* after = same(later, window);
      if (before != nullptr && after != nullptr) add(window, *before, *after);
    }
    return pulls_.size() >= kFewestWindows;
  }

  /// What the residuals are, by their medians: a slip is one among drives that slip seldom.
  void measure() {
    is_sharp_ = true;
    for (int kind = 0; kind < kResiduals; ++kind) {
      std::vector<double> sizes;
      for (const Residuals& residuals : residuals_) sizes.push_back(std::abs(residuals[kind]));
      unit_[kind] = std::max(kMedianToSigma * median(std::move(sizes)), kMinUnit);
    }
  }

  /// Between the same places.
  static const DriveWindow* same(const std::vector<DriveWindow>& windows,
                                 const DriveWindow& window) {
    const auto begin = [](const DriveWindow& of) { return of.steps.front().from_ns; };
    const auto found = std::ranges::lower_bound(windows, begin(window), {}, begin);
    return found != windows.end() && begin(*found) == begin(window) ? &*found : nullptr;
  }

  void add(const DriveWindow& window, const DriveWindow& earlier, const DriveWindow& later) {
    const Residuals sigma =
        (unit_.cwiseAbs2() + unevenness_of(window).cwiseAbs2()).cwiseSqrt().eval();
    const auto residuals = [&](const DriveWindow& of, const Vector& p) -> Residuals {
      return residuals_of(of, geometry_, p).cwiseQuotient(sigma);
    };
    const Residuals now = residuals(window, p_);
    residuals_.push_back(now.cwiseProduct(sigma));
    Eigen::Matrix<double, kResiduals, kParameters> slope;
    constexpr double kNudge = 1e-5;
    for (int i = 0; i < kDelay; ++i) {
      Vector nudged = p_;
      nudged[i] += kNudge;
      slope.col(i) = (residuals(window, nudged) - now) / kNudge;
    }
    slope.col(kDelay) = (residuals(later, p_) - residuals(earlier, p_)) / (2 * kDelayNudge_s);
    const Residuals weight =
        now.unaryExpr([&](double r) { return is_sharp_ ? tukey_weight(r) : cauchy_weight(r); });
    const Residuals curve = now.unaryExpr(
        [&](double r) { return is_sharp_ ? tukey_curvature(r) : cauchy_curvature(r); });
    unweighted_ += slope.cwiseAbs2().colwise().sum().transpose();
    information_ += slope.transpose() * weight.asDiagonal() * slope;
    curvature_ += slope.transpose() * curve.asDiagonal() * slope;
    pulls_.push_back(slope.transpose() * weight.cwiseProduct(now));
    gradient_ += pulls_.back();
    has_gyro_ = has_gyro_ || window.steps.front().has_gyro;
  }

  std::span<const OdometryIncrement> steps_;
  std::span<const KnownPose> places_;
  core::DriveGeometry geometry_;
  double start_s_;
  bool with_delay_ = true;
  bool is_sharp_ = false;
  bool has_gyro_ = false;
  Vector p_ = Vector::Zero();
  Vector prior_;  ///< its information
  Matrix information_;
  Vector unweighted_;  ///< its diagonal if all windows weighed the same
  Matrix curvature_;
  Vector gradient_;
  Residuals unit_ = Residuals::Ones();  ///< what they are, of what they should be
  std::vector<Residuals> residuals_;    ///< of each window, in what they should be
  std::vector<Vector> pulls_;           ///< of each window
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
