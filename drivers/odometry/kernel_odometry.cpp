// SPDX-License-Identifier: MIT
#include "drivers/odometry/kernel_odometry.hpp"

#include <algorithm>
#include <chrono>

namespace cornerd::drivers {
namespace {

/// Period of searching for missing devices and of checking the others.
constexpr core::TimeNs kRefresh_ns = core::kNsPerSecond;
/// Counts read farther apart are not a pair: at 1 m/s a wheel rolls 5 mm meanwhile.
constexpr core::TimeNs kMaxPairSpread_ns = 5'000'000;
constexpr core::TimeNs kNsPerMs = 1'000'000;

}  // namespace

KernelOdometry::KernelOdometry(const KernelOdometryConfig& config, Clock& clock)
    : clock_(clock),
      period_ns_(core::from_seconds(1 / config.rate_hz)),
      left_(config.sysfs, config.left),
      right_(config.sysfs, config.right),
      gyro_(config.sysfs, config.gyro),
      stuck_(config.geometry) {
  publish();
}

void KernelOdometry::run(std::stop_token stop, OdometrySink& sink) {
  core::TimeNs next_ns = clock_.monotonic_ns();
  core::TimeNs refresh_ns = next_ns;
  while (!stop.stop_requested()) {
    const core::TimeNs now_ns = clock_.monotonic_ns();
    if (now_ns >= refresh_ns) {
      refresh();
      refresh_ns = now_ns + kRefresh_ns;
    }
    poll(sink);
    publish();
    // Missed polls are not made up for.
    next_ns = std::max(next_ns + period_ns_, now_ns);
    const core::TimeNs rest_ns = next_ns - clock_.monotonic_ns();
    if (rest_ns > 0) {
      clock_.wait(std::chrono::milliseconds((rest_ns + kNsPerMs - 1) / kNsPerMs), stop);
    }
  }
}

void KernelOdometry::refresh() {
  left_.refresh();
  right_.refresh();
  gyro_.refresh();
}

void KernelOdometry::poll(OdometrySink& sink) {
  core::OdometryReading reading;
  // The gyro comes first: its bus takes 1 ms, and the reading's time is that of the counts.
  reading.gyro_rad_s = gyro_.read();
  const core::TimeNs before_ns = clock_.monotonic_ns();
  reading.left = left_.read();
  reading.right = right_.read();
  const core::TimeNs after_ns = clock_.monotonic_ns();
  if (reading.left && reading.right && after_ns - before_ns > kMaxPairSpread_ns) {
    ++late_;
    reading.left.reset();
    reading.right.reset();
  }
  if (!reading.left && !reading.right && !reading.gyro_rad_s) return;
  stuck_.add(reading);
  left_.set_stuck(stuck_.left_is_stuck());
  right_.set_stuck(stuck_.right_is_stuck());
  gyro_.set_stuck(stuck_.gyro_is_stuck());
  reading.t_ns = before_ns + (after_ns - before_ns) / 2;
  reading.arrival_ns = after_ns;
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
  status.counters.invalid_values =
      left_.invalid_values() + right_.invalid_values() + gyro_.invalid_values();
  status.counters.wraps = left_.wraps() + right_.wraps();
  status.counters.late = late_;
  latest_.publish(status);
}

}  // namespace cornerd::drivers
