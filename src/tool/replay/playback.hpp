// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <cstddef>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/odometry/odometry_reading.hpp"
#include "core/pipeline.hpp"
#include "core/types.hpp"
#include "drivers/lidar_driver.hpp"
#include "replay/recording.hpp"

namespace cornerd::tool {

/// Plays recordings through the daemon's own pipeline.
class Playback {
 public:
  /// Called for every scan; both arguments are valid during the call alone.
  using OnScan = std::function<void(const core::Scan& scan, const core::ScanResult& result)>;
  /// Called after every piece of the recording, with the time and the counters so far.
  using OnPiece = std::function<void(core::TimeNs t_ns, const drivers::StreamCounters& counters)>;

  /// Called for every pose between two scans (odometry.publish_predictions,
  /// localizer.updates_per_scan).
  using OnPrediction = std::function<void(const core::PoseEstimate& pose)>;

  Playback(core::Pipeline& pipeline, OnScan on_scan, OnPiece on_piece = {});

  /// Called for every reading of wheels and gyro.
  using OnReading = std::function<void(const core::OdometryReading& reading)>;

  void set_on_reading(OnReading on_reading) { on_reading_ = std::move(on_reading); }
  /// Called for every ODOMETRY line that cannot be read.
  void set_on_refusal(std::function<void(const message::RequestError& error)> on_refusal) {
    on_refusal_ = std::move(on_refusal);
  }
  void set_on_prediction(OnPrediction on_prediction) { on_prediction_ = std::move(on_prediction); }

  /// Resets the localizer after every scan.
  void set_independent(bool independent) { independent_ = independent; }

  /// Replaces the recording's odometry by these readings in ascending time.
  void set_odometry(std::vector<core::OdometryReading> readings) {
    readings_ = std::move(readings);
  }

  /// Plays one file with a fresh localizer. Reports skipped lines on standard error. Throws
  /// replay::RecordingError, and Failure if the file holds no complete scan.
  void play(const std::filesystem::path& file, const replay::RecordingOptions& options);

 private:
  class Sink;

  void on_result(const core::ScanResult* result);
  void on_intermediate_pose(const core::PoseEstimate* pose);

  core::Pipeline& pipeline_;
  OnScan on_scan_;
  OnPiece on_piece_;
  OnPrediction on_prediction_;
  OnReading on_reading_;
  std::function<void(const message::RequestError& error)> on_refusal_;
  void add(const core::OdometryReading& reading);

  bool independent_ = false;
  std::optional<std::vector<core::OdometryReading>> readings_;
  std::size_t scans_ = 0;
};

/// "max": nullopt; else how many times real time, above 0. Throws UsageError.
std::optional<double> parse_speed(const std::string& text);

/// Plays recorded data in scaled real time.
class Pace {
 public:
  explicit Pace(double speed) : speed_(speed) {}

  /// Sleeps until the time since the first call equals that of the data, divided by the speed.
  void wait_until(core::TimeNs data_ns);

 private:
  using Clock = std::chrono::steady_clock;

  double speed_;
  std::optional<core::TimeNs> first_data_ns_;
  Clock::time_point began_;
};

/// The ODOMETRY lines of a file in their order; skips other lines. Throws Failure if the file
/// cannot be read, has a bad line or no reading.
std::vector<core::OdometryReading> load_odometry(const std::filesystem::path& file);

}  // namespace cornerd::tool
