// SPDX-License-Identifier: MIT
// The config file: every key, its default, its limits.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "calibration/wall_model.hpp"
#include "core/localizer.hpp"
#include "core/odometry/odometry_config.hpp"
#include "settings/file_kind.hpp"

namespace cornerd::settings {

/// Anybody's text as one printable line: control characters become '?'.
std::string one_line(std::string text);

/// A config, map or override that is wrong. what() is one line: file, JSON pointer, reason.
class SettingsError : public std::runtime_error {
 public:
  SettingsError(const std::string& file, const std::string& pointer, const std::string& reason);
};

/// EX_CONFIG of sysexits.h: what a program ends with on a SettingsError.
inline constexpr int kExitConfig = 78;

enum class DriverKind : std::uint8_t { kRplidar, kReplay };
enum class MotorKind : std::uint8_t { kDtr, kGpio, kPwm, kNone };

/// What a port can be set to.
inline constexpr std::array<std::uint32_t, 9> kBaudRates = {
    9'600, 19'200, 38'400, 57'600, 115'200, 230'400, 460'800, 921'600, 1'000'000};

struct MountConfig {
  double x_m = 0;
  double y_m = 0;
  double theta_rad = 0;
  bool inverted = false;
};

struct MotorConfig {
  MotorKind kind = MotorKind::kDtr;
  std::filesystem::path path;  ///< sysfs folder of the GPIO line or PWM channel
  double duty = 1.0;           ///< of a PWM channel, 0..1
  double period_s = 4e-5;      ///< of a PWM channel
};

struct NoiseConfig {
  core::SensorNoise sensor;     ///< what the localizer believes in
  calibration::WallModel wall;  ///< what a simulated lidar errs by before a wall, on top
};

struct LidarConfig {
  DriverKind driver = DriverKind::kRplidar;
  std::filesystem::path device = "/dev/ttyUSB0";
  std::uint32_t baud = 115200;
  std::string mode =
      "auto";  ///< or a mode's name as the device gives it: "Standard", "Express" ...
  double min_range_m = 0.15;
  double max_range_m = 12.0;
  NoiseConfig noise;
  core::SensorBias bias;
  bool calibrate_online = true;
  /// What was learnt is kept here from one run to the next; empty: where the service manager has a
  /// folder for it, else nowhere.
  std::filesystem::path learned_file;
  MountConfig mount;
  MotorConfig motor;
  std::filesystem::path file;  ///< replay: the recording
  double speed = 1.0;          ///< replay: times real time; 0: as fast as it goes
  bool loop = false;           ///< replay: begin again at the end
};

enum class OdometrySource : std::uint8_t { kNone, kSocket, kKernel };

/// Encoders and gyro by the board's own drivers: drivers/odometry/README.md.
struct KernelOdometryConfig {
  struct Encoder {
    std::string counter;  ///< its name
    int count = 0;
    bool reversed = false;
  };
  Encoder left{.counter = "48300180.counter"};   ///< eQEP0 of a BeagleBone
  Encoder right{.counter = "48304180.counter"};  ///< eQEP2
  struct Gyro {
    std::string device =
        "mpu6050";  ///< its name or label; empty ("none" in the file): there is none
    char axis = 'z';
    bool reversed = false;
  };
  Gyro gyro;
  double rate_hz = 50;
  std::filesystem::path sysfs = "/sys";
};

/// As far as the running filter looks for one.
inline constexpr double kMostStartDelay_s = 0.2;

struct OdometryConfig {
  OdometrySource source = OdometrySource::kNone;
  KernelOdometryConfig kernel;
  core::OdometryConfig core;  ///< `enabled` where there is a source
};

struct LocalizationConfig {
  core::RecognitionMethod recognition = core::RecognitionMethod::kPatterns;
  int updates_per_scan = 1;
};

struct SocketConfig {
  std::filesystem::path pose = "/run/cornerd/pose.sock";
  std::filesystem::path control = "/run/cornerd/control.sock";
};

struct RealtimeConfig {
  int priority = 50;
  bool lock_memory = true;
};

struct Config {
  LidarConfig lidar;
  std::filesystem::path map;  ///< absolute, or as given where the config came from no file
  core::DetectorConfig detector;
  LocalizationConfig localization;
  OdometryConfig odometry;
  SocketConfig socket;
  RealtimeConfig realtime;

  core::LocalizerConfig localizer() const;
};

/// Reads a config file. Relative paths in it become absolute, from the folder of the file.
/// `overrides`: "/json/pointer=value", applied before the checks; the value is JSON, or else taken
/// as a string. Throws SettingsError.
Config load_config(const std::filesystem::path& file,
                   const std::vector<std::string>& overrides = {}, FileKind kind = FileKind::kAny);

/// The same from text. `file` names it in errors; `require_map`: a config without map is an error.
Config parse_config(std::string_view text, const std::filesystem::path& file,
                    const std::vector<std::string>& overrides = {}, bool require_map = true);

}  // namespace cornerd::settings
