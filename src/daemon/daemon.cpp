// SPDX-License-Identifier: MIT
#include "daemon/daemon.hpp"

#include <spdlog/spdlog.h>
#include <sys/epoll.h>

#include <chrono>
#include <cstring>
#include <utility>

#include "daemon/clock.hpp"
#include "daemon/memory_lock.hpp"

namespace cornerd::daemon {
namespace {

using std::chrono::microseconds;
using std::chrono::milliseconds;

/// How soon a change of the lidar's state is noticed.
constexpr milliseconds kTick{100};
constexpr int kTicksPerStatus = 10;

SourceKind source_of(settings::DriverKind driver) {
  return driver == settings::DriverKind::kReplay ? SourceKind::kRecording : SourceKind::kDevice;
}

/// Asked for and refused is worth a line, and costs nothing else.
void ask_for_realtime(const settings::RealtimeConfig& config, Localization& localization) {
  if (config.priority > 0) {
    if (const int error = localization.prioritize_reader(config.priority)) {
      spdlog::warn("priority {} is refused: {}; the unit's real-time drop-in allows it",
                   config.priority, std::strerror(error));
    }
  }
  if (config.lock_memory) {
    if (const int error = lock_memory()) {
      spdlog::warn("memory is not locked: {}; the unit's real-time drop-in allows it",
                   std::strerror(error));
    }
  }
}

}  // namespace

Daemon::Daemon(const settings::Config& config, std::shared_ptr<const core::WallMap> map,
               core::Pipeline pipeline, std::unique_ptr<drivers::LidarDriver> lidar,
               std::string version)
    : is_live_(config.lidar.driver != settings::DriverKind::kReplay),
      server_(loop_, std::move(version), control_actions(config)),
      turns_(server_, map),
      status_(server_, notifier_),
      tick_(kTick),
      lidar_(std::move(lidar)),
      localization_(*lidar_, std::move(pipeline), source_of(config.lidar.driver)) {
  server_.listen(config.socket.pose, SocketRole::kPose);
  server_.listen(config.socket.control, SocketRole::kControl);
  // Only who has the sockets is this robot's daemon, and may touch its port.
  localization_.start();
  // A recording brings its own.
  auto odometry = is_live_ ? make_odometry(config.odometry) : nullptr;
  if (odometry) {
    odometry_.emplace(std::move(odometry), localization_);
    status_.set_odometry(&*odometry_);
  }
  ask_for_realtime(config.realtime, localization_);

  loop_.add(signals_.fd(), EPOLLIN, [this](std::uint32_t) { on_signal(); });
  loop_.add(tick_.fd(), EPOLLIN, [this](std::uint32_t) { on_tick(); });
  loop_.add(localization_.event_fd(), EPOLLIN, [this](std::uint32_t) {
    localization_.take([this](const TurnReport& report) { turns_.publish(report); });
  });
  if (const auto period_us = notifier_.watchdog_period_us()) {
    watchdog_.emplace(microseconds(*period_us));
    loop_.add(watchdog_->fd(), EPOLLIN, [this](std::uint32_t) { on_watchdog(); });
  }
}

ControlActions Daemon::control_actions(const settings::Config& config) {
  ControlActions actions;
  actions.relocalize = [this] { localization_.relocalize(); };
  actions.set_pose = [this](const message::SetPoseRequest& request) {
    localization_.set_pose(request.T_map_base);
  };
  if (config.odometry.source == settings::OdometrySource::kSocket) {
    actions.add_odometry = [this](message::OdometryReading reading) {
      if (is_live_) {
        reading.t_ns = reading.timed ? reading.t_ns - (unix_ns() - monotonic_ns()) : monotonic_ns();
      } else if (!reading.timed) {
        reading.t_ns = now_ns();
      }
      localization_.add(reading);
    };
  }
  return actions;
}

void Daemon::run() {
  // The sockets accept and the settings hold; whether there is a lidar is a state, not a condition.
  notifier_.ready();
  loop_.run();
  notifier_.stopping();
}

void Daemon::on_signal() {
  spdlog::info("{}: ending", signals_.take());
  loop_.stop();
}

void Daemon::on_tick() {
  tick_.acknowledge();
  if (is_live_) {
    if (const auto step_ns = clock_.step_ns(unix_ns(), monotonic_ns())) {
      const std::string text = fmt::format("{:+.3f} s", core::to_seconds(*step_ns));
      spdlog::warn("clock step: {}", text);
      server_.publish(message::MessageClass::kEvent, line_.event(now_ns(), "clock step", text));
    }
  }
  publish_changes();
  const bool sensors_changed = odometry_ && odometry_->notice_changes(server_, now_ns());
  if (ticks_++ % kTicksPerStatus == 0 || sensors_changed) {
    status_.publish(lidar_->status(), turns_, localization_, now_ns());
  }
}

void Daemon::publish_changes() {
  drivers::LidarChange change;
  while (lidar_->take_change(change)) {
    if (!status_.notice(change, now_ns())) continue;
    // Some states last for milliseconds: each is told all the same.
    drivers::LidarStatus then = lidar_->status();
    then.state = change.state;
    then.fault = change.fault;
    then.detail = change.detail;
    status_.publish(then, turns_, localization_, now_ns());
  }
}

void Daemon::on_watchdog() {
  watchdog_->acknowledge();
  // That this runs shows that the server lives; the localizer has to show it too. A driver that
  // waits for its device is healthy, however long that takes.
  if (localization_.has_progressed()) notifier_.alive();
}

core::TimeNs Daemon::now_ns() const {
  return is_live_ ? unix_ns() : turns_.end_of_newest_turn_ns();
}

}  // namespace cornerd::daemon
