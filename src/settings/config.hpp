// SPDX-License-Identifier: MIT
// The values of a config file, with their defaults. The keys are in config_table.cpp.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "calibration/wall_model.hpp"
#include "core/localizer_config.hpp"
#include "core/odometry/odometry_config.hpp"
#include "drivers/config/kernel_odometry_config.hpp"
#include "drivers/config/lidar_models.hpp"
#include "drivers/config/motor_config.hpp"

namespace cornerd::settings {

/// Any text as one printable line: control characters become '?'.
std::string one_line(std::string text);

/// A config, map or override that is wrong. what() is one line: file, JSON pointer, reason.
class SettingsError : public std::runtime_error {
 public:
  SettingsError(const std::string& file, const std::string& pointer, const std::string& reason);
};

/// EX_CONFIG of sysexits.h: the exit code after a SettingsError.
inline constexpr int kExitConfig = 78;

/// kOrdinary: a regular file alone, since opening a pipe without a writer blocks.
enum class FileKind : std::uint8_t { kOrdinary, kAny };

using drivers::DriverKind;

/// Speeds of a serial port.
inline constexpr std::size_t kMaxConfigBytes = 1 << 20;
inline constexpr std::uint32_t kMinBaud = 1'200;
inline constexpr std::uint32_t kMaxBaud = 4'000'000;

struct MountConfig {
  double x_m = 0;
  double y_m = 0;
  double theta_rad = 0;
  bool inverted = false;
};

struct NoiseConfig {
  core::SensorNoise sensor;     ///< of the detector and the localizer
  calibration::WallModel wall;  ///< of a simulated lidar before a wall, in addition
};

struct LidarConfig {
  DriverKind driver = DriverKind::kRplidar;
  std::filesystem::path device = "/dev/ttyUSB0";
  std::uint32_t baud = 0;     ///< 0: those of the driver's models in turn
  std::string mode = "auto";  ///< or the device's own name of a mode: "Standard", "Express"
  double min_range_m = 0.15;
  double max_range_m = 12.0;
  NoiseConfig noise;
  core::SensorBias bias;
  bool calibrate_online = true;
  /// Keeps the estimated bias from one run to the next; empty: a file in the service manager's
  /// state folder, or none.
  std::filesystem::path calibration_file;
  MountConfig mount;
  rplidar::MotorConfig motor;
  std::filesystem::path file;  ///< replay: the recording
  double speed = 1.0;          ///< replay: times real time; 0: without pauses
  bool loop = false;           ///< replay: start again at the end
};

enum class OdometrySource : std::uint8_t { kNone, kSocket, kKernel };

/// The filter estimates no larger delay.
inline constexpr double kMaxInitialDelay_s = 0.2;

struct OdometryConfig {
  OdometrySource source = OdometrySource::kNone;
  drivers::KernelOdometryConfig kernel = {
      .left = {.counter = "48300180.counter"},   // eQEP0 of a BeagleBone
      .right = {.counter = "48304180.counter"},  // eQEP2
      .gyro = {.device = "mpu6050"}};
  core::OdometryConfig core;  ///< `enabled` where there is a source
};

struct SocketConfig {
  std::filesystem::path pose = "/run/cornerd/pose.sock";
  std::filesystem::path control = "/run/cornerd/control.sock";
};

struct RealtimeConfig {
  int priority = 50;
  bool lock_memory = true;
};

/// "map": the scans choose one of `maps`.
inline constexpr std::string_view kAutoMap = "auto";

struct NamedMap {
  std::string name;
  std::filesystem::path file;  ///< as Config::map
};

/// The file of the map with this name, of the first for kAutoMap; null where there is none.
const std::filesystem::path* file_of(std::span<const NamedMap> maps, std::string_view name);
/// "ground, first", for messages.
std::string names_of(std::span<const NamedMap> maps);

struct Config {
  LidarConfig lidar;
  std::filesystem::path map;  ///< absolute, or as given where the config came from no file
  /// Of the one of `maps` that `map` is, or kAutoMap: then `map` is the first; else empty.
  std::string map_name;
  std::vector<NamedMap> maps;
  bool chooses_map() const { return map_name == kAutoMap; }
  core::DetectorConfig detector;
  std::size_t updates_per_scan = 1;
  bool learn_walls = true;
  /// Keeps what was learned from one run to the next, a file for each map; empty: the service
  /// manager's state folder, or none.
  std::filesystem::path walls_folder;
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
/// `model`: the lidar, whose noise is the default; null: the first of the driver.
Config parse_config(std::string_view text, const std::filesystem::path& file,
                    const std::vector<std::string>& overrides = {}, bool require_map = true,
                    const drivers::LidarModel* model = nullptr);

/// /lidar/noise of a config, or of a file that has nothing else. Throws SettingsError, also where
/// the file does not have it.
NoiseConfig load_noise(const std::filesystem::path& file);

/// The pointers of all values that differ and take effect at the next start only, separated by
/// ", ".
std::string needs_restart(Config before, Config now);

}  // namespace cornerd::settings
