// SPDX-License-Identifier: MIT
#include "drivers/odometry/kernel_odometry.hpp"

#include <algorithm>
#include <chrono>

namespace cornerd::drivers {
namespace {

/// How often missing devices are looked for, and those at hand checked for being set up.
constexpr core::TimeNs kLook_ns = core::kNsPerSecond;
/// Two counts that were read farther apart say more about the scheduler than about the robot: at
/// 1 m/s a wheel rolls 5 mm meanwhile.
constexpr core::TimeNs kTogether_ns = 5'000'000;
constexpr core::TimeNs kNsPerMs = 1'000'000;

}  // namespace

KernelOdometry::KernelOdometry(const KernelOdometryConfig& config, Clock& clock)
    : clock_(clock),
      period_ns_(core::from_seconds(1 / config.rate_hz)),
      left_(config.sysfs, config.left),
      right_(config.sysfs, config.right),
      gyro_(config.sysfs, config.gyro),
      freeze_(config.geometry) {
  publish();
}

void KernelOdometry::run(std::stop_token stop, OdometrySink& sink) {
  core::TimeNs next_ns = clock_.monotonic_ns();
  core::TimeNs look_ns = next_ns;
  while (!stop.stop_requested()) {
    const core::TimeNs now_ns = clock_.monotonic_ns();
    if (now_ns >= look_ns) {
      look();
      look_ns = now_ns + kLook_ns;
    }
    poll(sink);
    publish();
    // After a pause it goes on at its pace; it does not make up for what it missed.
    next_ns = std::max(next_ns + period_ns_, now_ns);
    const core::TimeNs rest_ns = next_ns - clock_.monotonic_ns();
    if (rest_ns > 0) {
      clock_.wait(std::chrono::milliseconds((rest_ns + kNsPerMs - 1) / kNsPerMs), stop);
    }
  }
}

void KernelOdometry::look() {
  left_.look();
  right_.look();
  gyro_.look();
}

void KernelOdometry::poll(OdometrySink& sink) {
  core::OdometryReading reading;
  // The gyro first: its bus takes a millisecond, the counts none, and the time is that of the
  // counts.
  reading.gyro_rad_s = gyro_.read();
  const core::TimeNs before_ns = clock_.monotonic_ns();
  reading.left = left_.read();
  reading.right = right_.read();
  const core::TimeNs after_ns = clock_.monotonic_ns();
  if (reading.left && reading.right && after_ns - before_ns > kTogether_ns) {
    ++late_;
    reading.left.reset();
    reading.right.reset();
  }
  if (!reading.left && !reading.right && !reading.gyro_rad_s) return;
  freeze_.add(reading);
  left_.set_frozen(freeze_.left_is_frozen());
  right_.set_frozen(freeze_.right_is_frozen());
  gyro_.set_frozen(freeze_.gyro_is_frozen());
  reading.t_ns = before_ns + (after_ns - before_ns) / 2;
  ++readings_;
  sink.on_reading(reading);
}

void KernelOdometry::publish() {
  OdometryStatus status;
  status.left = left_.status();
  status.right = right_.status();
  status.gyro = gyro_.status();
  status.counters.readings = readings_;
  status.counters.failed_reads =
      left_.failed_reads() + right_.failed_reads() + gyro_.failed_reads();
  status.counters.garbage = left_.garbage() + right_.garbage() + gyro_.garbage();
  status.counters.wraps = left_.wraps() + right_.wraps();
  status.counters.late = late_;
  latest_.publish(status);
}

}  // namespace cornerd::drivers
