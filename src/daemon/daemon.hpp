// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <optional>
#include <string_view>

#include "core/map/wall_map.hpp"
#include "daemon/calibration_file.hpp"
#include "daemon/event_loop.hpp"
#include "daemon/learned_walls_file.hpp"
#include "daemon/localization.hpp"
#include "daemon/message_server.hpp"
#include "daemon/odometry_clients.hpp"
#include "daemon/odometry_reader.hpp"
#include "daemon/posix_clock.hpp"
#include "daemon/rate_limited_log.hpp"
#include "daemon/reloader.hpp"
#include "daemon/scan_publisher.hpp"
#include "daemon/status_publisher.hpp"
#include "daemon/systemd.hpp"
#include "drivers/lidar_driver.hpp"
#include "settings/config.hpp"

namespace cornerd::daemon {

/// The program: takes samples from a driver and publishes messages to clients.
class Daemon {
 public:
  /// Opens the sockets and starts the threads. Throws std::runtime_error.
  /// `loaded`: by `loader`, while signals still end the program at once.
  Daemon(Loaded loaded, MapLoader loader, std::unique_ptr<drivers::LidarDriver> lidar,
         std::string_view version);

  /// Runs until SIGTERM or SIGINT.
  void run();

 private:
  ControlActions control_actions(const settings::Config& config);
  void on_tick();
  void publish_changes();
  void update_calibration_file();
  /// Its pipeline, with what is known of the lidar and of the map's walls.
  std::unique_ptr<core::Pipeline> with_learned(Loaded& loaded);
  /// The noise of the lidar that is there, where the config has none.
  void follow_model(const drivers::LidarStatus& lidar);
  void on_watchdog();
  void on_signal();
  void on_loaded();
  void refuse(const Reloader::Outcome& outcome);
  void configure_localization(const settings::Config& config);
  void set_up_realtime();
  /// UNIX time live; the recording's time in a replay.
  core::TimeNs now_ns() const { return is_live_ ? unix_ns() : scans_.end_of_newest_scan_ns(); }

  Reloader reloader_;  ///< the first, as its destructor may end the process
  settings::Config config_;
  const bool is_live_;
  Signals signals_;  ///< constructed before any thread
  EventLoop loop_;
  Notifier notifier_;
  /// Before server_, whose destructor calls it.
  OdometryClients odometry_clients_{config_.odometry.source == settings::OdometrySource::kSocket};
  MessageServer server_;
  ScanPublisher scans_;
  StatusPublisher status_;
  ClockStepDetector clock_;
  RateLimitedLog clock_steps_{LogLevel::kWarning, "clock step"};
  PeriodicTimer tick_;
  std::optional<PeriodicTimer> watchdog_;
  message::LineWriter line_;
  int ticks_ = 0;
  DaemonHealth health_;
  /// There may be many SET_MAP and SIGHUP.
  RateLimitedLog map_refusals_{LogLevel::kError, "map refused, the old one stays in use"};
  RateLimitedLog reload_refusals_{LogLevel::kError,
                                  "reload refused, the old config and map stay in use"};
  RateLimitedLog loaded_maps_{LogLevel::kInfo, "map loaded"};
  const drivers::LidarModel* model_;  ///< whose noise is used, unless the config has one
  CalibrationFile calibration_;
  LearnedWallsFile walls_;
  std::unique_ptr<drivers::LidarDriver> lidar_;
  Localization localization_;
  std::optional<OdometryReader> odometry_;  ///< last: its thread uses localization_
};

}  // namespace cornerd::daemon
