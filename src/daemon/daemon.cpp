// SPDX-License-Identifier: MIT
#include "daemon/daemon.hpp"

#include <signal.h>
#include <sys/epoll.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>
#include <cstring>
#include <utility>

#include "daemon/initial_pose.hpp"
#include "daemon/log.hpp"
#include "daemon/open_sockets.hpp"
#include "daemon/posix_clock.hpp"
#include "daemon/realtime.hpp"
#include "drivers/config/lidar_models.hpp"

namespace cornerd::daemon {
namespace {

using std::chrono::microseconds;
using std::chrono::milliseconds;

/// Period at which changes of the lidar's state are published.
constexpr milliseconds kTick{100};
constexpr int kTicksPerStatus = 10;

ScanPublisher::PublishedMaps published(const std::vector<LoadedMap>& loaded,
                                       const settings::Config& config) {
  ScanPublisher::PublishedMaps maps{
      loaded, {}, {config.lidar.min_range_m, config.lidar.max_range_m}};
  if (config.maps.empty()) return maps;
  for (const LoadedMap& map : loaded) maps.names.push_back(map.map->plan().name);
  return maps;
}

SourceKind source_of(settings::DriverKind driver) {
  return driver == settings::DriverKind::kReplay ? SourceKind::kRecording : SourceKind::kDevice;
}

}  // namespace

Daemon::Daemon(Loaded loaded, MapLoader loader, std::unique_ptr<drivers::LidarDriver> lidar,
               std::string_view version)
    : reloader_(std::move(loader)),
      config_(std::move(loaded.config)),
      is_live_(config_.lidar.driver != settings::DriverKind::kReplay),
      server_(loop_, version, control_actions(config_)),
      scans_(server_, published(loaded.maps, config_)),
      status_(server_, notifier_),
      tick_(kTick),
      model_(drivers::first_lidar_model(config_.lidar.driver)),
      calibration_(calibration_file_path(config_.lidar), config_.lidar.bias),
      walls_(learned_walls_folder(config_)),
      lidar_(std::move(lidar)),
      localization_(*lidar_, with_learned(loaded), source_of(config_.lidar.driver)) {
  status_.configure(config_);
  log(LogLevel::kInfo, "map in use: " + describe(loaded.maps));
  log_doubts(loaded);
  open_sockets(server_, config_.socket);
  // The sockets are opened first: a second instance fails before it touches the serial port.
  configure_localization(config_);
  localization_.start();
  // A recording contains its own odometry.
  if (auto odometry = is_live_ ? make_odometry(config_.odometry) : nullptr) {
    odometry_.emplace(std::move(odometry), localization_);
    status_.set_odometry(&*odometry_);
  }
  if (is_live_ && config_.odometry.source == settings::OdometrySource::kSocket)
    status_.set_odometry(&odometry_clients_);
  set_up_realtime();

  loop_.add(signals_.fd(), EPOLLIN, [this](std::uint32_t) { on_signal(); });
  loop_.add(tick_.fd(), EPOLLIN, [this](std::uint32_t) { on_tick(); });
  loop_.add(reloader_.event_fd(), EPOLLIN, [this](std::uint32_t) { on_loaded(); });
  loop_.add(localization_.event_fd(), EPOLLIN, [this](std::uint32_t) {
    localization_.take_odometry_readings([this](const core::OdometryReading& reading) {
      status_.observe(reading);
      scans_.publish(reading, is_live_ ? unix_ns() - monotonic_ns() : 0);
    });
    localization_.take(
        [this](const ScanReport& report) {
          scans_.publish(report);
          status_.observe(report);
        },
        [this](const core::PoseEstimate& pose) { scans_.publish(pose); });
    scans_.publish_odometry(localization_);
  });
  if (const auto period_us = notifier_.watchdog_period_us()) {
    watchdog_.emplace(microseconds(*period_us));
    loop_.add(watchdog_->fd(), EPOLLIN, [this](std::uint32_t) { on_watchdog(); });
  }
}

void Daemon::configure_localization(const settings::Config& config) {
  localization_.publish_predictions(config.odometry.core.publish_predictions);
  localization_.localize_parts(config.updates_per_scan > 1);
}

/// Refusals are logged; the daemon runs without real-time privileges.
void Daemon::set_up_realtime() {
  const settings::RealtimeConfig& config = config_.realtime;
  if (config.priority > 0) {
    if (const int error = localization_.prioritize_reader(config.priority)) {
      log(LogLevel::kWarning, "real-time priority " + std::to_string(config.priority) +
                                  " refused: " + std::strerror(error) +
                                  "; install the unit's real-time drop-in");
    } else {
      health_.priority = config.priority;
      log(LogLevel::kInfo, "the reader thread has real-time priority " +
                               std::to_string(config.priority) + " (SCHED_FIFO)");
    }
  }
  if (config.lock_memory) {
    const int error = lock_memory();
    health_.memory_is_locked = error == 0;
    if (error != 0) {
      prefault_memory();
      log(LogLevel::kWarning, std::string("memory lock refused: ") + std::strerror(error) +
                                  "; install the unit's real-time drop-in");
    }
  }
}

ControlActions Daemon::control_actions(const settings::Config& config) {
  ControlActions actions;
  actions.relocalize = [this] { localization_.relocalize(); };
  actions.set_pose = [this](const message::SetPoseRequest& request) {
    std::optional<message::RequestError> refusal = outside_of(scans_.map(), request.T_map_base);
    if (!refusal) localization_.set_initial_pose(request.T_map_base);
    return refusal;
  };
  actions.set_map = [this](const message::SetMapRequest& request, const Ticket& ticket) {
    return reloader_.start({request, ticket});
  };
  if (config.odometry.source == settings::OdometrySource::kSocket) {
    actions.add_odometry = [this](message::OdometryReading reading, int connection) {
      const core::TimeNs arrival_ns = monotonic_ns();
      const auto verdict = odometry_clients_.accept(connection, arrival_ns, reading);
      if (is_live_) {
        reading.t_ns = reading.timed ? reading.t_ns - (unix_ns() - arrival_ns) : arrival_ns;
        reading.arrival_ns = arrival_ns;
      } else if (!reading.timed) {  // the last scan's time does not advance within a scan
        reading.t_ns = localization_.newest_sample_ns();
      }
      if (reading.left || reading.right || reading.gyro_rad_s) localization_.add(reading);
      return verdict != OdometryClients::Verdict::kFirstRejection;
    };
    actions.disconnect = [this](int connection) { odometry_clients_.disconnect(connection); };
  }
  actions.refuse_odometry = [this](const auto& error) {
    odometry_clients_.refuse(error);
    if (is_live_) status_.set_odometry(&odometry_clients_);
  };
  return actions;
}

void Daemon::run() {
  // Ready without a lidar: its absence is a state that STATUS reports.
  notifier_.ready();
  loop_.run();
  notifier_.stopping();
}

void Daemon::on_signal() {
  const int signal = signals_.take();
  if (signal == SIGHUP) {
    notifier_.reloading();
    reloader_.start({});
  } else if (signal != 0) {
    log(LogLevel::kInfo, signal == SIGTERM ? "SIGTERM: ending" : "SIGINT: ending");
    loop_.stop();
  }
}

void Daemon::refuse(const Reloader::Outcome& outcome) {
  const bool is_reload = outcome.job.is_reload();
  if (outcome.job.set_map) {
    map_refusals_.add(outcome.error, monotonic_ns());
  } else {
    reload_refusals_.add(outcome.error, monotonic_ns());
  }
  server_.publish(
      message::MessageClass::kEvent,
      line_.event(now_ns(), outcome.job.set_map ? "map refused" : "reload refused", outcome.error));
  if (is_reload) return notifier_.ready();
  if (outcome.job.set_map)
    server_.answer_later(outcome.job.ticket, message::RequestError{"map", outcome.error});
}

void Daemon::on_loaded() {
  Reloader::Outcome outcome = reloader_.take();
  if (!outcome.error.empty()) return refuse(outcome);
  Loaded& loaded = outcome.loaded;
  if (!loaded.pipeline) return;
  const bool is_reload = outcome.job.is_reload();
  if (const std::string list = settings::needs_restart(config_, loaded.config);
      is_reload && !list.empty()) {
    log(LogLevel::kWarning, "restart cornerd to apply: " + list);
  }
  const std::string name = describe(loaded.maps);
  if (!calibration_.reconfigure(loaded.config.lidar.bias)) localization_.forget_lidar();
  configure_localization(loaded.config);
  status_.configure(loaded.config);
  config_.lidar.calibrate_online = loaded.config.lidar.calibrate_online;
  scans_.set_next_maps(localization_.replace_pipeline(with_learned(loaded)),
                       published(loaded.maps, loaded.config));
  if (health_.memory_is_locked) health_.memory_is_locked = lock_memory() == 0;
  if (config_.realtime.lock_memory && !health_.memory_is_locked) prefault_memory();
  if (const auto* model = outcome.job.model) {
    log(LogLevel::kInfo, "lidar noise: that of model " + std::string(model->name));
    return;
  }
  loaded_maps_.add(name, monotonic_ns());
  log_doubts(loaded);
  server_.publish(message::MessageClass::kEvent, line_.event(now_ns(), "map loaded", name));
  if (is_reload) return notifier_.ready();
  server_.answer_later(outcome.job.ticket, std::nullopt);
}

void Daemon::on_tick() {
  health_.server.add(tick_.acknowledge().count());
  if (is_live_) {
    if (const auto step_ns = clock_.step_ns(unix_ns(), monotonic_ns())) {
      std::array<char, 64> text{};
      std::snprintf(text.data(), text.size(), "%+.3f s", core::to_seconds(*step_ns));
      clock_steps_.add(text.data(), monotonic_ns());
      const auto event = line_.event(now_ns(), "clock step", text.data());
      server_.publish(message::MessageClass::kEvent, event);
    }
    clock_steps_.flush(monotonic_ns());
  }
  map_refusals_.flush(monotonic_ns());
  reload_refusals_.flush(monotonic_ns());
  loaded_maps_.flush(monotonic_ns());
  scans_.publish_odometry(localization_);
  publish_changes();
  update_calibration_file();
  follow_model(lidar_->status());
  if (lidar_->status().state != drivers::LidarState::kRunning) scans_.publish_next_map();
  const bool has_changed = odometry_ && odometry_->publish_changes(server_, now_ns());
  odometry_clients_.update(scans_.odometry().counters, now_ns());
  const bool is_time = ticks_++ % kTicksPerStatus == 0;
  const drivers::LidarStatus lidar = lidar_->status();
  if (is_time || has_changed) status_.publish(lidar, scans_, localization_, health_, now_ns());
  if (is_time) {
    status_.set_walls(walls_.update(localization_, scans_.map()).get(), scans_.map(), now_ns());
    status_.set_file_problems(walls_.problem(), calibration_.problem());
    server_.restore_sockets([](const std::string& line) { log(LogLevel::kWarning, line); });
  }
}

void Daemon::follow_model(const drivers::LidarStatus& lidar) {
  const drivers::LidarModel* const before = model_;
  if (lidar.known_model == nullptr || lidar.known_model == before) return;
  model_ = lidar.known_model;
  if (before == nullptr || !model_->has_noise_of(*before)) reloader_.start({.model = model_});
}

void Daemon::update_calibration_file() {
  const drivers::LidarStatus lidar = lidar_->status();
  if (!calibration_.identify(lidar.serial.view())) {
    localization_.forget_lidar();
    const std::string text = "serial number " + std::string(lidar.serial.view());
    log(LogLevel::kInfo, "another lidar, " + text + ": its bias is estimated anew");
    server_.publish(message::MessageClass::kEvent, line_.event(now_ns(), "another lidar", text));
  }
  if (scans_.lidar() == localization_.lidar()) calibration_.update(scans_.bias());
}

std::unique_ptr<core::Pipeline> Daemon::with_learned(Loaded& loaded) {
  core::MapChoice& maps = loaded.pipeline->maps();
  if (config_.lidar.calibrate_online) maps.resume(calibration_.estimate());
  for (core::Localizer& localizer : maps.localizers()) walls_.resume(localizer, *localizer.map());
  return std::move(loaded.pipeline);
}

void Daemon::publish_changes() {
  drivers::LidarChange change;
  while (lidar_->take_change(change)) {
    if (!status_.update(change, now_ns())) continue;
    // Each state is published, even if it lasted only for milliseconds.
    drivers::LidarStatus then = lidar_->status();
    then.state = change.state;
    then.fault = change.fault;
    then.detail = change.detail;
    status_.publish(then, scans_, localization_, health_, now_ns());
  }
}

void Daemon::on_watchdog() {
  watchdog_->acknowledge();
  // Reader and localizer must make progress too. A driver that waits for its device does.
  if (localization_.has_progressed()) notifier_.alive();
}

}  // namespace cornerd::daemon
