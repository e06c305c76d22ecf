// SPDX-License-Identifier: MIT
// The interface of every lidar: a device on a port, or a recording that replaces one.
#pragma once

#include <atomic>
#include <cstdint>
#include <stop_token>

#include "core/odometry/odometry_reading.hpp"
#include "core/types.hpp"
#include "drivers/lidar_status.hpp"

namespace cornerd::drivers {

/// Receives what a driver delivers, on the driver's thread.
class SampleSink {
 public:
  virtual ~SampleSink() = default;
  virtual void on_sample(const core::Sample& sample) = 0;
  /// When the last byte of the next sample's packet arrived, monotonic: before a sample that starts
  /// a scan, from devices.
  virtual void on_arrival(core::TimeNs /*arrival_ns*/) {}
  /// An unknown number of samples is missing here: begin a new scan.
  virtual void on_gap() = 0;
  /// Odometry from a recording that holds both, in order of time among the samples.
  virtual void on_reading(const core::OdometryReading& /*reading*/) {}
  /// False while there is no room for another sample. Only an unpaced recording waits for it.
  virtual bool ready() const { return true; }
};

class LidarDriver {
 public:
  virtual ~LidarDriver() = default;

  /// The body of the reader thread: delivers samples until a stop is requested or the source ends.
  /// Never throws; device faults are states, retried with back-off.
  virtual void run(std::stop_token stop, SampleSink& sink) = 0;

  /// The newest status. For one thread; never blocks run().
  virtual LidarStatus status() = 0;

  /// The oldest state change not yet taken; false if there is none. Same thread as status().
  virtual bool take_change(LidarChange& change) = 0;

  /// Grows as long as run() is not stuck, whatever the device does. Any thread.
  std::uint32_t progress_count() const { return progress_.load(std::memory_order_relaxed); }

 protected:
  void count_progress() { progress_.fetch_add(1, std::memory_order_relaxed); }

 private:
  std::atomic<std::uint32_t> progress_{0};
};

}  // namespace cornerd::drivers
