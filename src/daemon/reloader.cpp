// SPDX-License-Identifier: MIT
#include "daemon/reloader.hpp"

#include <sys/eventfd.h>

#include <exception>
#include <string_view>
#include <utility>

namespace cornerd::daemon {

Reloader::Reloader(Load load)
    : load_(std::move(load)),
      done_(require_fd(::eventfd(0, EFD_NONBLOCK | EFD_CLOEXEC), "eventfd")) {}

void Reloader::start() {
  reload_pending_ = is_loading_;
  if (is_loading_) return;
  is_loading_ = true;
  thread_ = std::jthread([this] { run(); });
}

void Reloader::run() {
  try {
    outcome_ = {load_(), {}};
  } catch (const std::exception& error) {
    outcome_ = {{}, error.what()};
  }
  ::eventfd_write(done_.get(), 1);
}

Reloader::Outcome Reloader::take() {
  eventfd_t count = 0;
  ::eventfd_read(done_.get(), &count);
  thread_.join();
  is_loading_ = false;
  Outcome outcome = std::exchange(outcome_, {});
  if (std::exchange(reload_pending_, false)) start();
  return outcome;
}

std::string needs_restart(const settings::Config& before, const settings::Config& now) {
  std::string list;
  const auto compare = [&list](std::string_view pointer, const auto& a, const auto& b) {
    if (a == b) return;
    if (!list.empty()) list += ", ";
    list += pointer;
  };
  const settings::LidarConfig& a = before.lidar;
  const settings::LidarConfig& b = now.lidar;
  compare("/lidar/driver", a.driver, b.driver);
  compare("/lidar/device", a.device, b.device);
  compare("/lidar/baud", a.baud, b.baud);
  compare("/lidar/mode", a.mode, b.mode);
  compare("/lidar/learned_file", a.learned_file, b.learned_file);
  compare("/lidar/mount/inverted", a.mount.inverted, b.mount.inverted);
  compare("/lidar/motor/kind", a.motor.kind, b.motor.kind);
  compare("/lidar/motor/path", a.motor.path, b.motor.path);
  compare("/lidar/motor/duty", a.motor.duty, b.motor.duty);
  compare("/lidar/motor/period", a.motor.period_s, b.motor.period_s);
  compare("/lidar/file", a.file, b.file);
  compare("/lidar/speed", a.speed, b.speed);
  compare("/lidar/loop", a.loop, b.loop);
  compare("/odometry/source", before.odometry.source, now.odometry.source);
  const settings::KernelOdometryConfig& from = before.odometry.kernel;
  const settings::KernelOdometryConfig& to = now.odometry.kernel;
  compare("/odometry/kernel/left/counter", from.left.counter, to.left.counter);
  compare("/odometry/kernel/left/count", from.left.count, to.left.count);
  compare("/odometry/kernel/left/reversed", from.left.reversed, to.left.reversed);
  compare("/odometry/kernel/right/counter", from.right.counter, to.right.counter);
  compare("/odometry/kernel/right/count", from.right.count, to.right.count);
  compare("/odometry/kernel/right/reversed", from.right.reversed, to.right.reversed);
  compare("/odometry/kernel/gyro/device", from.gyro.device, to.gyro.device);
  compare("/odometry/kernel/gyro/axis", from.gyro.axis, to.gyro.axis);
  compare("/odometry/kernel/gyro/reversed", from.gyro.reversed, to.gyro.reversed);
  compare("/odometry/kernel/rate", from.rate_hz, to.rate_hz);
  compare("/odometry/kernel/sysfs", from.sysfs, to.sysfs);
  compare("/socket/pose", before.socket.pose, now.socket.pose);
  compare("/socket/control", before.socket.control, now.socket.control);
  compare("/realtime/priority", before.realtime.priority, now.realtime.priority);
  compare("/realtime/lock_memory", before.realtime.lock_memory, now.realtime.lock_memory);
  return list;
}

}  // namespace cornerd::daemon
