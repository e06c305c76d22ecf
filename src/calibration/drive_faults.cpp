// SPDX-License-Identifier: MIT
#include "calibration/drive_faults.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "calibration/drive_bank.hpp"
#include "calibration/drive_model.hpp"
#include "calibration/robust_statistics.hpp"

namespace cornerd::calibration {
namespace {

/// Windows with a stuck gyro.
constexpr std::ptrdiff_t kMinStuck = 3;
/// Raw counts of a gyro of 250 degrees a second are 7,506 times the rate (MPU-6050 data sheet,
/// 6.1), millidegrees 57,296.
constexpr double kLargestGyroFactor = 1e5;

/// Normalizes posteriors of hypotheses with logarithms in `posterior`; keeps what cannot be told
/// apart.
template <typename Hypothesis>
std::vector<Hypothesis> named(std::vector<Hypothesis> all) {
  double most = all.front().posterior;
  double none = 0;
  for (const Hypothesis& one : all) most = std::max(most, one.posterior);
  double sum = 0;
  for (Hypothesis& one : all) sum += one.posterior = std::exp(one.posterior - most);
  for (Hypothesis& one : all) {
    one.posterior /= sum;
    if (one.fault == decltype(one.fault)::kNone) none += one.posterior;
  }
  if (!(none < DriveFaults::kMaxPosterior)) return {};
  const double least = DriveFaults::kMinRatio / sum;
  std::erase_if(all, [&](const Hypothesis& one) {
    return one.posterior < least || one.fault == decltype(one.fault)::kNone;
  });
  std::stable_sort(all.begin(), all.end(), [](const Hypothesis& a, const Hypothesis& b) {
    return a.posterior > b.posterior;
  });
  return all;
}

std::vector<GyroHypothesis> gyro_bank(std::span<const MotionWindow> all) {
  std::vector<MotionWindow> windows;
  std::vector<double> ratios;
  for (const MotionWindow& window : all) {
    if (!window.has_gyro) continue;
    windows.push_back(window);
    const double gyro_rad = window.counted[0].gyro_rad;
    if (std::abs(gyro_rad) > 1e-3 && std::abs(window.rotation_rad) > kMinRotation_rad) {
      ratios.push_back(window.rotation_rad / gyro_rad);
    }
  }
  std::vector<GyroHypothesis> hypotheses;
  const auto add = [&](GyroFault fault, double prior, const GyroModel& model) {
    const GyroFit fit = fit_gyro_model(windows, model);
    hypotheses.push_back({fault, std::log(prior) + fit.log_evidence, 1 / fit.share,
                          -fit.rest_rad_s / fit.share, kDelays_s[model.delay]});
  };
  for (std::size_t i = 0; i < kDelays_s.size(); ++i) {
    const bool is_harmless = i < kHarmlessDelays;
    add(is_harmless ? GyroFault::kNone : GyroFault::kDelay, is_harmless ? kPriorRight : kPriorFault,
        {.delay = i});
  }
  add(GyroFault::kReversed, kPriorFault, {.share = -1});
  add(GyroFault::kDegrees, kPriorFault, {.share = core::radians(1)});
  add(GyroFault::kDegreesReversed, kPriorFault, {.share = -core::radians(1)});
  add(GyroFault::kBias, kPriorFault, {.bias_sigma_rad_s = 1});
  add(GyroFault::kUnrelated, kPriorFault, {.trusts_gyro = false});
  const double share = median(std::move(ratios));
  if (std::abs(share) > 1 / kLargestGyroFactor && std::abs(share) < kLargestFactor &&
      std::abs(std::log(std::abs(share))) > kMinFactorChange &&
      std::abs(std::log(std::abs(share) / core::radians(1))) > kMinFactorChange) {
    add(GyroFault::kFactor, kPriorFault / kFactorCells / 2, {.share = share});
  }
  return hypotheses;
}

}  // namespace

DriveFaults find_drive_faults(std::span<const MotionWindow> windows,
                              const core::Pose2& T_base_lidar, const core::DriveGeometry& geometry,
                              bool mount_is_known) {
  DriveFaults faults;
  if (windows.empty()) return faults;
  faults.mount = fit_free_mount(windows, T_base_lidar, geometry);
  faults.drive = named(drive_bank(windows, T_base_lidar, geometry));
  if (mount_is_known && !faults.drive.empty() &&
      faults.drive.front().reduced_chi_square > DriveFaults::kMaxReducedChiSquare) {
    faults.drive = {{.fault = DriveFault::kBothUnrelated, .posterior = 1}};
  }
  const auto stuck = std::ranges::count_if(windows, &MotionWindow::gyro_is_stuck);
  // The gate sees that without the lidar; the bank has the windows before.
  faults.gyro = stuck >= kMinStuck
                    ? std::vector<GyroHypothesis>{{.fault = GyroFault::kStuck, .posterior = 1}}
                    : named(gyro_bank(windows));
  return faults;
}

}  // namespace cornerd::calibration
