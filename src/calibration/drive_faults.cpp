// SPDX-License-Identifier: MIT
#include "calibration/drive_faults.hpp"

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
constexpr double kTurned_rad = core::kPi / 2;
/// Priors, before normalization: right; one fault; two at once.
constexpr double kPriorRight = 1;
constexpr double kPriorFault = 0.01;
constexpr double kPriorTwoFaults = 1e-4;
/// A factor is one of any between 1 / kLargestFactor and kLargestFactor, each as likely on a
/// logarithmic scale; a cell of them is as wide as the errors of measured wheels.
constexpr double kLargestFactor = 60;
const double kFactorCells = 2 * std::log(kLargestFactor) / (0.07 * std::sqrt(2 * core::kPi));
/// Nearer to 1 a factor is none.
constexpr double kMinFactorChange = 0.25;
/// Of the lidar's path: counts that change less are those of a silent encoder.
constexpr double kSilentShare = 0.01;
/// Windows with less do not tell of a factor.
constexpr double kMinTravel_m = 0.02;
constexpr double kMinRotation_rad = 0.1;

std::vector<WheelTravel> travel_of(std::span<const MotionWindow> windows, const Wiring& wiring,
                                   double left_factor, double right_factor) {
  std::vector<WheelTravel> travel;
  travel.reserve(windows.size());
  for (const MotionWindow& window : windows) {
    const double left = (wiring.left_is_reversed ? -1 : 1) * left_factor * window.left_m;
    const double right = (wiring.right_is_reversed ? -1 : 1) * right_factor * window.right_m;
    travel.push_back(wiring.is_swapped ? WheelTravel{right, left} : WheelTravel{left, right});
  }
  return travel;
}

/// Normalizes posteriors of hypotheses with logarithms in `posterior`; keeps what cannot be told
/// apart.
template <typename Hypothesis>
std::vector<Hypothesis> named(std::vector<Hypothesis> all) {
  double most = all.front().posterior;
  for (const Hypothesis& one : all) most = std::max(most, one.posterior);
  double sum = 0;
  for (Hypothesis& one : all) sum += one.posterior = std::exp(one.posterior - most);
  for (Hypothesis& one : all) one.posterior /= sum;
  if (!(all.front().posterior < DriveFaults::kMaxPosterior)) return {};
  const double least = DriveFaults::kMinRatio / sum;
  std::erase_if(all, [&](const Hypothesis& one) { return one.posterior < least; });
  std::stable_sort(all.begin(), all.end(), [](const Hypothesis& a, const Hypothesis& b) {
    return a.posterior > b.posterior;
  });
  return all;
}

class DriveBank {
 public:
  DriveBank(std::span<const MotionWindow> windows, const core::Pose2& T_base_lidar,
            const core::DriveGeometry& geometry)
      : windows_(windows), mount_(T_base_lidar), track_m_(geometry.track_m) {}

  std::vector<DriveHypothesis> run() {
    add_wirings();
    add_single_wheels();
    add_track();
    add_unrelated();
    add_mounts();
    return std::move(all_);
  }

  DriveHypothesis free_mount() const {
    DriveHypothesis hypothesis;
    const DriveFit fit = fit_drive_model(
        windows_, travel_of(windows_, {}, 1, 1),
        {track_m_, track_m_, turned_to(best_turn()), {kDisplaced_m, kDisplaced_m, kTurned_rad}});
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
    all_.push_back(hypothesis);
  }

  DriveModel as_configured() const { return {track_m_, track_m_, mount_, kMeasured}; }

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
    }
  }

  void add_single_wheels() {
    for (const bool is_left : {true, false}) {
      std::vector<double> ratios;
      for (const MotionWindow& window : windows_) {
        const double counted_m = is_left ? window.left_m : window.right_m;
        if (std::abs(counted_m) < kMinTravel_m) continue;
        const double half_m = window.rotation_rad * track_m_ / 2;
        ratios.push_back((forward_m(window) + (is_left ? -half_m : half_m)) / counted_m);
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
      ratios.push_back((window.right_m - window.left_m) / window.rotation_rad / track_m_);
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
      left_m += std::abs(window.left_m);
      right_m += std::abs(window.right_m);
      path_m += window.lidar_m.norm();
    }
    const auto add_one = [&](DriveFault fault, bool trusts_left, bool trusts_right) {
      DriveModel model = as_configured();
      model.trusts_left = trusts_left;
      model.trusts_right = trusts_right;
      const bool is_silent = (trusts_left || left_m < kSilentShare * path_m) &&
                             (trusts_right || right_m < kSilentShare * path_m);
      // Silence says that the encoder is dead; noise may have many reasons.
      add({.fault = fault, .is_silent = is_silent}, is_silent ? kPriorFault : kPriorTwoFaults,
          model, travel_of(windows_, {}, 1, 1));
    };
    add_one(DriveFault::kLeftUnrelated, false, true);
    add_one(DriveFault::kRightUnrelated, true, false);
    add_one(DriveFault::kBothUnrelated, false, false);
  }

  void add_mounts() {
    const std::vector<WheelTravel> travel = travel_of(windows_, {}, 1, 1);
    // A lidar is mounted along an axis of the robot, or anyhow.
    for (const double turn_rad : {core::kPi, core::kPi / 2, -core::kPi / 2}) {
      add({.fault = DriveFault::kMountTurned}, kPriorFault,
          {track_m_, track_m_, turned_to(mount_.theta_rad + turn_rad), kMeasured}, travel);
    }
    const core::Pose2 any_turn{kMeasured.x_m, kMeasured.y_m, kTurned_rad};
    const core::Pose2 anywhere{kDisplaced_m, kDisplaced_m, kTurned_rad};
    add({.fault = DriveFault::kMountTurned}, kPriorFault,
        {track_m_, track_m_, turned_to(best_turn()), any_turn}, travel);
    add({.fault = DriveFault::kMountDisplaced}, kPriorFault,
        {track_m_, track_m_, mount_, {kDisplaced_m, kDisplaced_m, kMeasured.theta_rad}}, travel);
    add({.fault = DriveFault::kMountBoth}, kPriorTwoFaults,
        {track_m_, track_m_, turned_to(best_turn()), anywhere}, travel);
  }

  core::Pose2 turned_to(double theta_rad) const {
    return {mount_.x_m, mount_.y_m, core::normalize_angle(theta_rad)};
  }

  /// The direction in which the lidar moves while the wheels roll forward: minus the mount's theta.
  double best_turn() const {
    core::Vec2 sum = core::Vec2::Zero();
    for (const MotionWindow& window : windows_) {
      sum += (window.left_m + window.right_m) / 2 * window.lidar_m;
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
      const double counted_m = (travel[i].left_m + travel[i].right_m) / 2;
      if (std::abs(counted_m) >= kMinTravel_m) ratios.push_back(forward_m(windows_[i]) / counted_m);
    }
    return checked(ratios);
  }

  static std::optional<double> checked(const std::vector<double>& ratios) {
    const double factor = median(ratios);
    const bool is_one = std::abs(std::log(std::max(factor, 1e-9))) < kMinFactorChange;
    if (!(factor > 1 / kLargestFactor && factor < kLargestFactor) || is_one) return std::nullopt;
    return factor;
  }

  std::span<const MotionWindow> windows_;
  core::Pose2 mount_;
  double track_m_;
  std::vector<DriveHypothesis> all_;
};

std::vector<GyroHypothesis> gyro_bank(std::span<const MotionWindow> all) {
  std::vector<MotionWindow> windows;
  std::vector<double> ratios;
  for (const MotionWindow& window : all) {
    if (!window.has_gyro) continue;
    windows.push_back(window);
    if (std::abs(window.gyro_rad) > 1e-3 && std::abs(window.rotation_rad) > kMinRotation_rad) {
      ratios.push_back(window.rotation_rad / window.gyro_rad);
    }
  }
  std::vector<GyroHypothesis> hypotheses;
  const auto add = [&](GyroFault fault, double prior, const GyroModel& model) {
    const GyroFit fit = fit_gyro_model(windows, model);
    hypotheses.push_back(
        {fault, std::log(prior) + fit.log_evidence, 1 / fit.share, -fit.rest_rad_s / fit.share});
  };
  add(GyroFault::kNone, kPriorRight, {});
  add(GyroFault::kReversed, kPriorFault, {.share = -1});
  add(GyroFault::kDegrees, kPriorFault, {.share = core::radians(1)});
  add(GyroFault::kDegreesReversed, kPriorFault, {.share = -core::radians(1)});
  add(GyroFault::kBias, kPriorFault, {.bias_sigma_rad_s = 1});
  add(GyroFault::kUnrelated, kPriorFault, {.trusts_gyro = false});
  const double share = median(std::move(ratios));
  if (std::abs(share) > 1 / kLargestFactor / 2 && std::abs(share) < kLargestFactor &&
      std::abs(std::log(std::abs(share))) > kMinFactorChange &&
      std::abs(std::log(std::abs(share) / core::radians(1))) > kMinFactorChange) {
    add(GyroFault::kFactor, kPriorFault / kFactorCells / 2, {.share = share});
  }
  return hypotheses;
}

}  // namespace

DriveFaults find_drive_faults(std::span<const MotionWindow> windows,
                              const core::Pose2& T_base_lidar,
                              const core::DriveGeometry& geometry) {
  DriveFaults faults;
  if (windows.empty()) return faults;
  DriveBank bank(windows, T_base_lidar, geometry);
  faults.mount = bank.free_mount();
  faults.drive = named(bank.run());
  faults.gyro = named(gyro_bank(windows));
  return faults;
}

}  // namespace cornerd::calibration
