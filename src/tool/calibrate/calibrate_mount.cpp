// SPDX-License-Identifier: MIT
// cornerctl calibrate mount: where the lidar sits on the robot, from a recorded drive.
#include <filesystem>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

#include "calibration/delay_search.hpp"
#include "calibration/drive_fault_text.hpp"
#include "calibration/motion_window.hpp"
#include "settings/odometry_names.hpp"
#include "tool/calibrate/calibration_drive.hpp"
#include "tool/command_line/command.hpp"
#include "tool/command_line/failure.hpp"
#include "tool/command_line/output.hpp"
#include "tool/command_line/shared_options.hpp"
#include "tool/commands.hpp"
#include "tool/drawing/text_table.hpp"

namespace cornerd::tool {
namespace {

using calibration::DriveFault;

/// Some seconds of scans that name a place.
constexpr std::size_t kMinPlaces = 50;
/// A fit that is less certain is none.
constexpr double kMaxSigma_m = 0.02;
constexpr double kMaxSigma_rad = core::radians(1);

class MountCalibration {
 public:
  explicit MountCalibration(const DriveOptions& options)
      : options_(options), config_(options.settings.resolve(/*needs_map=*/true)) {}

  const settings::Config& config() const { return config_; }

  void run() {
    choose_inverted();
    const calibration::DriveFaults first = faults_of(drive_);
    alternatives_ = first.drive;
    std::erase_if(alternatives_, [](const auto& one) { return is_mount(one); });
    if (!first.drive.empty() && !is_mount(first.drive.front())) {
      fail("correct the odometry first: " +
           calibration::describe(first, settings::odometry_names(config_)));
    }
    take(first.mount);
    // Scans of a drive are deskewed by a mount that is right.
    drive_ = play(config_.lidar.mount.inverted, /*deskewed=*/true);
    take(faults_of(drive_).mount);
  }

  std::string report() const {
    const settings::MountConfig& mount = config_.lidar.mount;
    TextTable table;
    const auto add = [&](const char* name, double value, double sigma) {
      table.add_row({name, formatted("%+.4f", value), formatted("+- %.4f", sigma)});
    };
    add("x, m", mount.x_m, sigma_.x_m);
    add("y, m", mount.y_m, sigma_.y_m);
    add("theta, rad", mount.theta_rad, sigma_.theta_rad);
    table.add_row({"inverted", mount.inverted ? "true" : "false",
                   tells_inverted_ ? "" : "as configured: the recording does not show it"});
    std::string text =
        formatted("The lidar on the robot, from %zu windows of a second:\n", windows_) +
        table.text();
    if (!alternatives_.empty()) {
      calibration::DriveFaults others;
      others.drive = alternatives_;
      text += "The drive fits as well if lidar.mount is right and " +
              calibration::describe(others, settings::odometry_names(config_)) + '\n';
    }
    return text;
  }

  std::string fragment() const {
    const settings::MountConfig& mount = config_.lidar.mount;
    const nlohmann::ordered_json json = {{"lidar",
                                          {{"mount",
                                            {{"x", mount.x_m},
                                             {"y", mount.y_m},
                                             {"theta", mount.theta_rad},
                                             {"inverted", mount.inverted}}}}}};
    return json.dump(2) + '\n';
  }

 private:
  [[noreturn]] void fail(const std::string& why) const {
    throw Failure(options_.file.string() + ": " + why);
  }

  static bool is_mount(const calibration::DriveHypothesis& one) {
    return one.fault == DriveFault::kMountTurned || one.fault == DriveFault::kMountDisplaced ||
           one.fault == DriveFault::kMountBoth;
  }

  CalibrationDrive play(bool inverted, bool deskewed) const {
    settings::Config config = config_;
    config.lidar.mount.inverted = inverted;
    return play_drive(options_.drive(), config, nullptr, deskewed);
  }

  /// A scan that is mirrored fits hardly anywhere.
  void choose_inverted() {
    const bool configured = config_.lidar.mount.inverted;
    drive_ = play(configured, /*deskewed=*/false);
    CalibrationDrive other = play(!configured, /*deskewed=*/false);
    tells_inverted_ = drive_.places.size() != other.places.size();
    if (other.places.size() > drive_.places.size()) {
      drive_ = std::move(other);
      config_.lidar.mount.inverted = !configured;
    }
    if (drive_.places.size() < kMinPlaces) {
      fail("only " + std::to_string(drive_.places.size()) +
           " scans were localized in the map: check the map, and record a minute's drive");
    }
    if (drive_.increments_within_wide_limits.empty()) {
      fail(
          "no ODOMETRY line with left and right in it: without wheels the drive does not tell "
          "forward from backward");
    }
  }

  calibration::DriveFaults faults_of(const CalibrationDrive& drive) {
    const core::Pose2 T_base_lidar = config_.localizer().T_base_lidar;
    const auto& steps = drive.increments_within_wide_limits;
    const double delay_s = calibration::search_delay(steps, drive.places, 0).delay_s;
    const auto windows = calibration::motion_windows(calibration::at_true_times(steps, delay_s),
                                                     drive.places, T_base_lidar);
    windows_ = windows.size();
    return calibration::find_drive_faults(windows, T_base_lidar, config_.odometry.core.geometry,
                                          /*mount_is_known=*/false);
  }

  void take(const calibration::DriveHypothesis& mount) {
    sigma_ = mount.sigma;
    const bool is_certain =
        sigma_.x_m < kMaxSigma_m && sigma_.y_m < kMaxSigma_m && sigma_.theta_rad < kMaxSigma_rad;
    if (windows_ == 0 || !is_certain) {
      fail("too few data: drive a minute, straight and with rotations in both directions");
    }
    config_.lidar.mount.x_m = mount.T_base_lidar.x_m;
    config_.lidar.mount.y_m = mount.T_base_lidar.y_m;
    config_.lidar.mount.theta_rad = mount.T_base_lidar.theta_rad;
  }

  const DriveOptions& options_;
  settings::Config config_;
  CalibrationDrive drive_;
  bool tells_inverted_ = false;
  std::size_t windows_ = 0;
  core::Pose2 sigma_;
  std::vector<calibration::DriveHypothesis> alternatives_;
};

void calibrate_mount(const DriveOptions& options) {
  MountCalibration calibration(options);
  guard_files({.read = {options.file, options.odometry, options.settings.config_file(),
                        calibration.config().map},
               .written = {},
               .output = options.output});
  calibration.run();
  Output report = Output::report_beside(options.output);
  report.write(calibration.report());
  report.flush();
  if (!options.output.empty()) write_file(options.output, calibration.fragment());
}

}  // namespace

void add_calibrate_mount(Command& group) {
  Command command = group.add_subcommand(
      "mount", "where the lidar sits on the robot, from a recorded drive in a known map");
  const auto options = std::make_shared<DriveOptions>();
  options->add_drive(command, "a minute, straight and with rotations in both directions",
                     "lidar.mount");
  command.callback([options] { calibrate_mount(*options); });
}

}  // namespace cornerd::tool
