// SPDX-License-Identifier: MIT
#include "tool/calibrate/drive_fit.hpp"

#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "calibration/delay_search.hpp"
#include "calibration/drive_fault_text.hpp"
#include "calibration/motion_window.hpp"
#include "settings/odometry_names.hpp"
#include "tool/command_line/failure.hpp"
#include "tool/drawing/text_table.hpp"

namespace cornerd::tool {
namespace {

using calibration::DelaySearch;

/// A larger share of rejected readings means wrong units, not outliers.
constexpr double kMaxRejectedShare = 0.1;
/// Scans deskewed by readings with a larger delay are deskewed again.
constexpr double kMaxDeskewDelay_s = 0.005;

class DriveFitter {
 public:
  DriveFitter(const DriveFile& file, const settings::Config& config, const Truth* truth)
      : file_(file), config_(config), truth_(truth) {}

  FittedDrive run() {
    CalibrationDrive drive = play(/*deskewed=*/true);
    if (drive.steps.empty() && drive.increments_within_wide_limits.empty()) {
      fail(drive.counters.readings == 0 ? "no odometry in it"
                                        : "none of its ODOMETRY lines has both left and right");
    }
    std::string faults = find_faults(drive);
    if (auto fit = faults.empty() ? fit_of(drive) : std::nullopt) {
      return {std::move(drive), *fit};
    }
    if (truth_ == nullptr) {
      // Wrong or late odometry may spoil the scans that would show its fault.
      CalibrationDrive plain = play(/*deskewed=*/false);
      if (plain.places.size() < 2) fail("the robot was not localized in the map: check the map");
      const std::string plain_faults = find_faults(plain);
      auto fit = plain_faults.empty() && search_.is_unambiguous ? fit_of(plain) : std::nullopt;
      if (fit) return {std::move(plain), *fit};
      if (faults.empty()) faults = plain_faults;
    }
    if (!faults.empty()) fail(faults);
    fail(
        "too few data for wheels and gyro: drive half a minute or more, straight and with "
        "rotations in both directions");
  }

 private:
  [[noreturn]] void fail(const std::string& why) const {
    throw Failure(file_.file.string() + ": " + why);
  }

  double configured_s() const { return config_.odometry.core.initial.delay_s; }

  CalibrationDrive play(bool deskewed) const {
    return play_drive(file_, config_, truth_, deskewed);
  }

  static bool is_wide(const CalibrationDrive& drive) {
    const core::OdometryCounters& counters = drive.counters;
    return static_cast<double>(counters.jumps + counters.invalid_rates) >
           kMaxRejectedShare * static_cast<double>(counters.readings);
  }

  /// Wiring faults, which no scale corrects; empty if there are none.
  std::string find_faults(CalibrationDrive& drive) {
    const auto& steps = is_wide(drive) ? drive.increments_within_wide_limits : drive.steps;
    search_ = calibration::search_delay(steps, drive.places, configured_s());
    if (search_.at_edge) {
      fail(
          formatted("the readings are %.1f s %s or more, the limit of the search: send the time of "
                    "measurement in each",
                    calibration::kMaxDelay_s, search_.delay_s > 0 ? "late" : "early"));
    }
    deskew(drive, search_.delay_s);
    calibration::OdometryNames names = settings::odometry_names(config_);
    if (truth_ != nullptr) names.T_base_lidar = {};
    const auto windows = calibration::motion_windows(
        calibration::at_true_times(steps, search_.delay_s), drive.places, names.T_base_lidar);
    return calibration::describe(
        calibration::find_drive_faults(windows, names.T_base_lidar, names.geometry), names);
  }

  /// Localizes again if the scans were deskewed by readings with a wrong delay.
  void deskew(CalibrationDrive& drive, double delay_s) const {
    if (truth_ != nullptr || std::abs(delay_s - configured_s()) <= kMaxDeskewDelay_s) return;
    auto places = localize_drive(file_, config_, drive.readings, delay_s);
    if (places.size() >= drive.places.size() / 2) drive.places = std::move(places);
  }

  std::optional<calibration::OdometryFit> fit_of(const CalibrationDrive& drive) const {
    return calibration::fit_odometry(drive.steps, drive.places, config_.odometry.core.geometry,
                                     search_.delay_s);
  }

  const DriveFile& file_;
  const settings::Config& config_;
  const Truth* truth_;
  DelaySearch search_;  ///< of the last drive
};

}  // namespace

FittedDrive fit_drive(const DriveFile& file, const settings::Config& config, const Truth* truth) {
  return DriveFitter(file, config, truth).run();
}

}  // namespace cornerd::tool
