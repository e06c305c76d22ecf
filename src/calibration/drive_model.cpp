// SPDX-License-Identifier: MIT
#include "calibration/drive_model.hpp"

#include <algorithm>
#include <limits>

#include "core/geometry/linear_solve.hpp"
#include "core/geometry/squared.hpp"

namespace cornerd::calibration {
namespace {

/// Parameters: theta, x, y of the mount; logarithms of what the left wheel, right wheel and track
/// are off by, so that too wide is as unlikely as too narrow.
enum DriveParameter { kTheta, kX, kY, kLeftScale, kRightScale, kTrackScale };
using Vector6 = Eigen::Matrix<double, 6, 1>;
using Matrix6 = Eigen::Matrix<double, 6, 6>;

/// Share of windows whose motion the sensors do not show: slips, wrong fixes.
constexpr double kOutliers = 0.05;
/// The same of a gyro, which does not slip.
constexpr double kGyroOutliers = 0.01;
/// Share of a robot's windows in which it does not rotate.
constexpr double kStraight = 0.8;
/// Of the motions of a robot in a second.
constexpr double kAnyMotion_m = 0.5;
constexpr double kAnyRotation_rad = 1;
/// Residuals of a window. Wheels: what a delay of 0.1 s makes of a change of speed; sideways: two
/// fixes alone.
constexpr double kForward_m = 0.015;
constexpr double kForwardShare = 0.03;
constexpr double kRotation_rad = 0.05;
constexpr double kRotationShare = 0.05;
constexpr double kWheelShare = 0.05;  ///< of a wheel's travel: small slips
constexpr double kSideways_m = 0.006;
constexpr double kSidewaysShare = 0.015;
constexpr double kGyro_rad = 0.03;
constexpr double kGyroShare = 0.03;
/// Of one residual in DriveFit's sum: more is an outlier.
constexpr double kMaxChiSquare = 9;
/// Graduated non-convexity: the sigmas begin so many times larger and halve, so that a start far
/// from the maximum has inliers.
constexpr double kFirstWidth = 8;
constexpr int kIterations = 7;

double width_of(int iteration) { return std::max(1.0, std::ldexp(kFirstWidth, -iteration)); }

double log_normal(double residual, double sigma) {
  return -0.5 * residual * residual / (sigma * sigma) - std::log(sigma * std::sqrt(2 * core::kPi));
}

/// Of a residual that is an inlier's or any motion's.
struct Mixture {
  double log_likelihood = 0;
  double inlier = 0;  ///< its probability

  Mixture(double residual, double sigma, double any, double outliers = kOutliers) {
    const double in = std::log(1 - outliers) + log_normal(residual, sigma);
    const double out = std::log(outliers) + log_normal(residual, std::hypot(sigma, any));
    const double most = std::max(in, out);
    log_likelihood = most + std::log(std::exp(in - most) + std::exp(out - most));
    inlier = std::exp(in - log_likelihood);
  }
};

/// One equation of a window: residual, its gradient, its sigma.
struct Equation {
  double residual = 0;
  Vector6 gradient = Vector6::Zero();
  double sigma = 1;
  double any = 1;
};

class DriveProblem {
 public:
  DriveProblem(std::span<const MotionWindow> windows, std::span<const WheelTravel> travel,
               const DriveModel& model)
      : windows_(windows), travel_(travel), model_(model) {
    mean_ << model.T_base_lidar.theta_rad, model.T_base_lidar.x_m, model.T_base_lidar.y_m, 0, 0, 0;
    sigma_ << model.mount_sigma.theta_rad, model.mount_sigma.x_m, model.mount_sigma.y_m,
        kMeasuredSigma, kMeasuredSigma, kMeasuredSigma;
  }

  DriveFit fit() const {
    Vector6 at = mean_;
    for (int i = 0; i < kIterations; ++i) {
      const Sums sums = sum(at, width_of(i));
      const core::SymmetricSolver<6> solver(sums.information);
      if (!solver.succeeded() || !solver.is_positive()) break;
      at += solver.solve(sums.gradient);
    }
    const Sums sums = sum(at, 1);
    const core::SymmetricSolver<6> solver(sums.information);
    const Vector6 off = (at - mean_).cwiseQuotient(sigma_);
    const auto sigma_of = [&](int i) { return std::sqrt(solver.solve(Vector6::Unit(i))[i]); };
    DriveFit fit;
    fit.T_base_lidar = {at[kX], at[kY], core::normalize_angle(at[kTheta])};
    fit.sigma = {sigma_of(kX), sigma_of(kY), sigma_of(kTheta)};
    fit.log_evidence = sums.log_likelihood - off.squaredNorm() / 2 - sigma_.array().log().sum() -
                       solver.pivots().array().log().sum() / 2;
    if (!std::isfinite(fit.log_evidence)) {
      fit.log_evidence = -std::numeric_limits<double>::infinity();
    }
    fit.reduced_chi_square = sums.chi_square / sums.residuals;
    return fit;
  }

 private:
  struct Sums {
    Matrix6 information;
    Vector6 gradient;
    double log_likelihood = 0;
    double chi_square = 0;
    int residuals = 0;
  };

  Sums sum(const Vector6& at, double width) const {
    Sums sums;
    const Vector6 weight = sigma_.cwiseAbs2().cwiseInverse();
    sums.information = weight.asDiagonal();
    sums.gradient = weight.cwiseProduct(mean_ - at);
    const auto add = [&](const Equation& equation) {
      const double sigma = width * equation.sigma;
      const Mixture mixture(equation.residual, sigma, equation.any);
      const double share = mixture.inlier / (sigma * sigma);
      sums.information += share * equation.gradient * equation.gradient.transpose();
      sums.gradient -= share * equation.residual * equation.gradient;
      sums.log_likelihood += mixture.log_likelihood;
      sums.chi_square += std::min(kMaxChiSquare, core::squared(equation.residual / sigma));
      ++sums.residuals;
    };
    for (std::size_t i = 0; i < windows_.size(); ++i) {
      const MotionWindow& window = windows_[i];
      const double c = std::cos(at[kTheta]);
      const double s = std::sin(at[kTheta]);
      const double along_m = c * window.lidar_m.x() - s * window.lidar_m.y();
      const double aside_m = s * window.lidar_m.x() + c * window.lidar_m.y();
      const double path_m = window.lidar_m.norm();
      Equation sideways;
      sideways.residual = aside_m - at[kX] * window.sine;
      sideways.gradient[kTheta] = along_m;
      sideways.gradient[kX] = -window.sine;
      sideways.sigma = std::hypot(kSideways_m, kSidewaysShare * path_m);
      sideways.any = kAnyMotion_m;
      add(sideways);
      add_wheels(window, travel_[i], at, along_m, aside_m, path_m, sums, add);
    }
    return sums;
  }

  /// Sigmas are by the lidar's motion and the configured track, so that no hypothesis gains by the
  /// noise that it supposes. Of one unrelated wheel the lidar's rotation takes the place.
  void add_wheels(const MotionWindow& window, const WheelTravel& travel, const Vector6& at,
                  double along_m, double aside_m, double path_m, Sums& sums,
                  const auto& add) const {
    const double left_m = std::exp(at[kLeftScale]) * travel.left_m;
    const double right_m = std::exp(at[kRightScale]) * travel.right_m;
    const double track_scale = std::exp(at[kTrackScale]);
    const core::DriveGeometry& configured = model_.configured;
    const double count_m2 = 2 * configured.quantization_variance();  // at both ends of the window
    const double wheel_sigma_m =
        std::hypot(kWheelShare * path_m, kWheelShare * window.rotation_rad * configured.track_m / 2,
                   std::sqrt(count_m2));
    const double rotation_sigma_rad =
        std::hypot(kRotation_rad, kRotationShare * window.rotation_rad,
                   std::sqrt(core::squared(wheel_sigma_m) + count_m2) / configured.track_m);
    Equation forward;
    forward.gradient[kTheta] = -aside_m;
    forward.gradient[kY] = window.sine;
    forward.any = kAnyMotion_m;
    forward.sigma = std::hypot(kForward_m, kForwardShare * path_m, std::sqrt(count_m2 / 2));
    forward.residual = along_m + at[kY] * window.sine;
    if (model_.trusts_left && model_.trusts_right) {
      forward.residual -= (left_m + right_m) / 2;
      forward.gradient[kLeftScale] = -left_m / 2;
      forward.gradient[kRightScale] = -right_m / 2;
      add(forward);
      Equation rotation;
      rotation.residual = window.rotation_rad * track_scale - (right_m - left_m) / model_.track_m;
      rotation.gradient[kLeftScale] = left_m / model_.track_m;
      rotation.gradient[kRightScale] = -right_m / model_.track_m;
      rotation.gradient[kTrackScale] = window.rotation_rad * track_scale;
      rotation.sigma = rotation_sigma_rad;
      rotation.any = kAnyRotation_rad;
      return add(rotation);
    }
    sums.log_likelihood += log_normal(window.rotation_rad, kAnyRotation_rad);
    if (!model_.trusts_left && !model_.trusts_right) {
      sums.log_likelihood += log_normal(along_m, kAnyMotion_m);
      return;
    }
    // One wheel and the rotation give the translation.
    const double half_m =
        (model_.trusts_left ? 1 : -1) * window.rotation_rad * track_scale * model_.track_m / 2;
    const double wheel_m = model_.trusts_left ? left_m : right_m;
    forward.residual -= wheel_m + half_m;
    forward.gradient[model_.trusts_left ? kLeftScale : kRightScale] = -wheel_m;
    forward.gradient[kTrackScale] = -half_m;
    forward.sigma = std::hypot(forward.sigma, wheel_sigma_m);
    add(forward);
  }

  std::span<const MotionWindow> windows_;
  std::span<const WheelTravel> travel_;
  const DriveModel& model_;
  Vector6 mean_;
  Vector6 sigma_;
};

}  // namespace

DriveFit fit_drive_model(std::span<const MotionWindow> windows, std::span<const WheelTravel> travel,
                         const DriveModel& model) {
  return DriveProblem(windows, travel, model).fit();
}

GyroFit fit_gyro_model(std::span<const MotionWindow> windows, const GyroModel& model) {
  GyroFit fit;
  if (!model.trusts_gyro) {
    for (const MotionWindow& window : windows) {
      fit.log_evidence +=
          Mixture(window.rotation_rad, kRotation_rad, kAnyRotation_rad, 1 - kStraight)
              .log_likelihood;
    }
    return fit;
  }
  const Eigen::Vector2d mean(1, 0);  // of a factor on the share, and of the rest
  const Eigen::Vector2d sigma(kMeasuredSigma, model.bias_sigma_rad_s);
  Eigen::Vector2d at = mean;
  Eigen::Matrix2d information;
  for (int i = 0;; ++i) {
    information = sigma.cwiseAbs2().cwiseInverse().asDiagonal();
    Eigen::Vector2d gradient = sigma.cwiseAbs2().cwiseInverse().cwiseProduct(mean - at);
    double log_likelihood = 0;
    for (const MotionWindow& window : windows) {
      const Eigen::Vector2d row(model.share * window.counted[model.delay].gyro_rad,
                                window.duration_s);
      const double residual = window.rotation_rad - row.dot(at);
      const double width = width_of(i) * std::hypot(kGyro_rad, kGyroShare * window.rotation_rad);
      const Mixture mixture(residual, width, kAnyRotation_rad, kGyroOutliers);
      const double share = mixture.inlier / (width * width);
      information += share * row * row.transpose();
      gradient += share * residual * row;
      log_likelihood += mixture.log_likelihood;
    }
    if (i == kIterations) {
      const Eigen::Vector2d off = (at - mean).cwiseQuotient(sigma);
      fit.log_evidence = log_likelihood - off.squaredNorm() / 2 - sigma.array().log().sum() -
                         std::log(core::determinant(information)) / 2;
      break;
    }
    at += core::inverse(information) * gradient;
  }
  fit.share = model.share * at[0];
  fit.rest_rad_s = at[1];
  return fit;
}

}  // namespace cornerd::calibration
