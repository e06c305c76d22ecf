// SPDX-License-Identifier: MIT
#include "calibration/drive_bank.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "calibration/drive_model.hpp"
#include "calibration/robust_statistics.hpp"

namespace cornerd::calibration {
namespace {

/// Of a mount that was measured with a tape: larger errors are faults.
constexpr core::Pose2 kMeasured{0.006, 0.006, core::radians(0.25)};
/// Of one that was not.
constexpr double kDisplaced_m = 0.15;
/// Of one in another unit, or of another point of the robot.
constexpr double kFar_m = 10;
constexpr double kTurned_rad = core::kPi / 2;
/// Of the lidar's path: counts that change less are those of a silent encoder.
constexpr double kSilentShare = 0.01;
/// Counts of both wheels that differ as little over so much of rotation are those of one wheel.
constexpr double kSameRotation_rad = 3;
/// By the lidar or by the counts: windows with less do not tell of a factor.
constexpr double kMinTravel_m = 0.02;

/// `delay`: of kDelays_s.
std::vector<WheelTravel> travel_of(std::span<const MotionWindow> windows, const Wiring& wiring,
                                   double left_factor, double right_factor, std::size_t delay = 0) {
  std::vector<WheelTravel> travel;
  travel.reserve(windows.size());
  for (const MotionWindow& window : windows) {
    const double left =
        (wiring.left_is_reversed ? -1 : 1) * left_factor * window.counted[delay].left_m;
    const double right =
        (wiring.right_is_reversed ? -1 : 1) * right_factor * window.counted[delay].right_m;
    travel.push_back(wiring.is_swapped ? WheelTravel{right, left} : WheelTravel{left, right});
  }
  return travel;
}

class DriveBank {
 public:
  DriveBank(std::span<const MotionWindow> windows, const core::Pose2& T_base_lidar,
            const core::DriveGeometry& geometry)
      : windows_(windows), mount_(T_base_lidar), geometry_(geometry) {}

  std::vector<DriveHypothesis> run() {
    add_wirings();
    add_single_wheels();
    add_track();
    add_unrelated();
    add_delays();
    add_mounts();
    if (wheels_are_same()) {
      // No other fault makes the counts of a robot that rotates the same.
      std::erase_if(all_, [](const DriveHypothesis& one) { return !one.is_copy; });
    }
    return std::move(all_);
  }

  DriveHypothesis free_mount() const {
    DriveHypothesis hypothesis;
    const DriveFit fit =
        fit_drive_model(windows_, travel_of(windows_, {}, 1, 1),
                        mounted(turned_to(best_turn()), {kDisplaced_m, kDisplaced_m, kTurned_rad}));
    hypothesis.T_base_lidar = fit.T_base_lidar;
    hypothesis.sigma = fit.sigma;
    return hypothesis;
  }

 private:
  void add(DriveHypothesis hypothesis, double prior, const DriveModel& model,
           const std::vector<WheelTravel>& travel) {
    const DriveFit fit = fit_drive_model(windows_, travel, model);
    hypothesis.posterior = std::log(prior) + fit.log_evidence;
    hypothesis.T_base_lidar = fit.T_base_lidar;
    hypothesis.sigma = fit.sigma;
    hypothesis.reduced_chi_square = fit.reduced_chi_square;
    all_.push_back(hypothesis);
  }

  DriveModel mounted(const core::Pose2& T_base_lidar, const core::Pose2& sigma) const {
    return {geometry_, geometry_.track_m, T_base_lidar, sigma};
  }
  DriveModel as_configured() const { return mounted(mount_, kMeasured); }

  /// The first is the one that nothing is wrong.
  void add_wirings() {
    for (int i = 0; i < 8; ++i) {
      const Wiring wiring{(i & 1) != 0, (i & 2) != 0, (i & 4) != 0};
      const DriveFault fault = i == 0 ? DriveFault::kNone : DriveFault::kWiring;
      add({.fault = fault, .wiring = wiring}, i == 0 ? kPriorRight : kPriorFault, as_configured(),
          travel_of(windows_, wiring, 1, 1));
    }
    for (int i = 0; i < 8; ++i) {
      const Wiring wiring{(i & 1) != 0, (i & 2) != 0, (i & 4) != 0};
      const auto factor = factor_of(travel_of(windows_, wiring, 1, 1));
      if (!factor) continue;
      add({.fault = i == 0 ? DriveFault::kCounts : DriveFault::kWiring,
           .wiring = wiring,
           .factor = *factor},
          (i == 0 ? kPriorFault : kPriorTwoFaults) / kFactorCells, as_configured(),
          travel_of(windows_, wiring, *factor, *factor));
      if (wiring != Wiring{true, true, true}) continue;
      // The same motion by a lidar that looks backward.
      add({.fault = DriveFault::kMountTurned, .factor = *factor}, kPriorTwoFaults / kFactorCells,
          mounted(turned_to(mount_.theta_rad + core::kPi), kMeasured),
          travel_of(windows_, {}, *factor, *factor));
    }
  }

  void add_single_wheels() {
    for (const bool is_left : {true, false}) {
      std::vector<double> ratios;
      for (const MotionWindow& window : windows_) {
        const double half_m = window.rotation_rad * geometry_.track_m / 2;
        const double moved_m = forward_m(window) + (is_left ? -half_m : half_m);
        const double counted_m = is_left ? window.counted[0].left_m : window.counted[0].right_m;
        if (tells_factor(moved_m, counted_m)) ratios.push_back(moved_m / counted_m);
      }
      const auto factor = checked(ratios);
      if (!factor) continue;
      add({.fault = is_left ? DriveFault::kLeftCounts : DriveFault::kRightCounts,
           .factor = *factor},
          kPriorFault / kFactorCells, as_configured(),
          travel_of(windows_, {}, is_left ? *factor : 1, is_left ? 1 : *factor));
    }
  }

  void add_track() {
    std::vector<double> ratios;
    for (const MotionWindow& window : windows_) {
      if (std::abs(window.rotation_rad) < kMinRotation_rad) continue;
      const CountedMotion& counted = window.counted[0];
      ratios.push_back((counted.right_m - counted.left_m) / window.rotation_rad /
                       geometry_.track_m);
    }
    const auto factor = checked(ratios);
    if (!factor) return;
    DriveModel model = as_configured();
    model.track_m *= *factor;
    add({.fault = DriveFault::kTrack, .track_m = model.track_m}, kPriorFault / kFactorCells, model,
        travel_of(windows_, {}, 1, 1));
  }

  void add_unrelated() {
    double left_m = 0;
    double right_m = 0;
    double path_m = 0;
    for (const MotionWindow& window : windows_) {
      left_m += std::abs(window.counted[0].left_m);
      right_m += std::abs(window.counted[0].right_m);
      path_m += window.lidar_m.norm();
    }
    const bool are_same = wheels_are_same();
    const auto add_one = [&](DriveFault fault, bool trusts_left, bool trusts_right) {
      DriveModel model = as_configured();
      model.trusts_left = trusts_left;
      model.trusts_right = trusts_right;
      const bool is_silent = (trusts_left || left_m < kSilentShare * path_m) &&
                             (trusts_right || right_m < kSilentShare * path_m);
      const bool is_copy = are_same && trusts_left != trusts_right;
      // Silence says that the encoder is dead; noise may have many reasons.
      add({.fault = fault, .is_silent = is_silent, .is_copy = is_copy},
          is_silent ? kPriorFault : kPriorTwoFaults, model, travel_of(windows_, {}, 1, 1));
    };
    add_one(DriveFault::kLeftUnrelated, false, true);
    add_one(DriveFault::kRightUnrelated, true, false);
    add_one(DriveFault::kBothUnrelated, false, false);
  }

  bool wheels_are_same() const {
    double apart_m = 0;
    double path_m = 0;
    double rotation_rad = 0;
    for (const MotionWindow& window : windows_) {
      if (std::abs(window.rotation_rad) < kMinRotation_rad) continue;
      apart_m += std::abs(window.counted[0].right_m - window.counted[0].left_m);
      path_m += std::abs(window.counted[0].left_m);
      rotation_rad += std::abs(window.rotation_rad);
    }
    return rotation_rad > kSameRotation_rad && apart_m < kSilentShare * path_m;
  }

  void add_delays() {
    for (std::size_t i = 1; i < kDelays_s.size(); ++i) {
      const bool is_harmless = i < kHarmlessDelays;
      add({.fault = is_harmless ? DriveFault::kNone : DriveFault::kDelay, .delay_s = kDelays_s[i]},
          is_harmless ? kPriorRight : kPriorFault, as_configured(),
          travel_of(windows_, {}, 1, 1, i));
    }
  }

  void add_mounts() {
    const std::vector<WheelTravel> travel = travel_of(windows_, {}, 1, 1);
    // A lidar is mounted along an axis of the robot, or anyhow.
    for (const double turn_rad : {core::kPi, core::kPi / 2, -core::kPi / 2}) {
      add({.fault = DriveFault::kMountTurned}, kPriorFault,
          mounted(turned_to(mount_.theta_rad + turn_rad), kMeasured), travel);
    }
    const core::Pose2 any_turn{kMeasured.x_m, kMeasured.y_m, kTurned_rad};
    const core::Pose2 anywhere{kDisplaced_m, kDisplaced_m, kTurned_rad};
    const core::Pose2 place = best_place();
    const bool is_far = (place.translation() - mount_.translation()).norm() > 3 * kDisplaced_m;
    const double displaced_m = is_far ? kFar_m : kDisplaced_m;
    add({.fault = DriveFault::kMountTurned}, kPriorFault, mounted(turned_to(best_turn()), any_turn),
        travel);
    add({.fault = DriveFault::kMountDisplaced}, kPriorFault,
        mounted(is_far ? place : mount_, {displaced_m, displaced_m, kMeasured.theta_rad}), travel);
    add({.fault = DriveFault::kMountBoth}, kPriorTwoFaults,
        mounted(turned_to(best_turn()), anywhere), travel);
  }

  core::Pose2 turned_to(double theta_rad) const {
    return {mount_.x_m, mount_.y_m, core::normalize_angle(theta_rad)};
  }

  /// Where the lidar moves as it does, if it looks where the config says.
  core::Pose2 best_place() const {
    std::vector<double> x_m;
    std::vector<double> y_m;
    const double c = std::cos(mount_.theta_rad);
    const double s = std::sin(mount_.theta_rad);
    for (const MotionWindow& window : windows_) {
      if (std::abs(window.sine) < kMinRotation_rad) continue;
      const core::Vec2& u = window.lidar_m;
      const double wheels_m = (window.counted[0].left_m + window.counted[0].right_m) / 2;
      x_m.push_back((s * u.x() + c * u.y()) / window.sine);
      y_m.push_back((wheels_m - c * u.x() + s * u.y()) / window.sine);
    }
    if (x_m.empty()) return mount_;
    return {median(x_m), median(y_m), mount_.theta_rad};
  }

  /// The direction in which the lidar moves while the wheels roll forward: minus the mount's theta.
  double best_turn() const {
    core::Vec2 sum = core::Vec2::Zero();
    for (const MotionWindow& window : windows_) {
      const CountedMotion& counted = window.counted[0];
      sum += (counted.left_m + counted.right_m) / 2 * window.lidar_m;
    }
    return sum.isZero() ? mount_.theta_rad : -core::angle_of(sum);
  }

  /// By the lidar, as it is mounted.
  double forward_m(const MotionWindow& window) const {
    return std::cos(mount_.theta_rad) * window.lidar_m.x() -
           std::sin(mount_.theta_rad) * window.lidar_m.y() + mount_.y_m * window.sine;
  }

  std::optional<double> factor_of(const std::vector<WheelTravel>& travel) const {
    std::vector<double> ratios;
    for (std::size_t i = 0; i < windows_.size(); ++i) {
      const double moved_m = forward_m(windows_[i]);
      const double counted_m = (travel[i].left_m + travel[i].right_m) / 2;
      if (tells_factor(moved_m, counted_m)) ratios.push_back(moved_m / counted_m);
    }
    return checked(ratios);
  }

  static bool tells_factor(double moved_m, double counted_m) {
    return std::max(std::abs(moved_m), std::abs(counted_m)) >= kMinTravel_m;
  }

  static std::optional<double> checked(const std::vector<double>& ratios) {
    const double factor = median(ratios);
    const bool is_one = std::abs(std::log(std::max(factor, 1e-9))) < kMinFactorChange;
    if (!(factor > 1 / kLargestFactor && factor < kLargestFactor) || is_one) return std::nullopt;
    return factor;
  }

  std::span<const MotionWindow> windows_;
  core::Pose2 mount_;
  core::DriveGeometry geometry_;
  std::vector<DriveHypothesis> all_;
};

}  // namespace

std::vector<DriveHypothesis> drive_bank(std::span<const MotionWindow> windows,
                                        const core::Pose2& T_base_lidar,
                                        const core::DriveGeometry& geometry) {
  return DriveBank(windows, T_base_lidar, geometry).run();
}

DriveHypothesis fit_free_mount(std::span<const MotionWindow> windows,
                               const core::Pose2& T_base_lidar,
                               const core::DriveGeometry& geometry) {
  return DriveBank(windows, T_base_lidar, geometry).free_mount();
}

}  // namespace cornerd::calibration
