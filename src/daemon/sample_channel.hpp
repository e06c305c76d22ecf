// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <cstdint>

#include "core/ring_buffer.hpp"
#include "drivers/lidar_driver.hpp"

namespace cornerd::daemon {

/// Between the reader and the localizer: samples in their order, and the holes between them.
///
/// The localizer has nothing to do until a turn is complete, so it sleeps (on a futex, by way of
/// std::atomic::wait) until a sample that can complete one wakes it: a handful of wake-ups a second
/// instead of one for every sample. A stream without turns wakes it every kWakeInterval
/// samples, before the ring can fill.
class SampleChannel final : public drivers::SampleSink {
 public:
  enum class Kind : std::uint8_t { kSample, kGap, kReading };
  struct Item {
    core::Sample sample;
    core::OdometryReading reading;
    std::int64_t arrival_ns = 0;  ///< monotonic; 0 for a sample in the middle of a turn
    Kind kind = Kind::kSample;
  };

  /// A device does not wait: what does not fit is lost, counted, and marked by a gap. A recording
  /// does.
  enum class WhenFull : std::uint8_t { kLose, kWait };
  explicit SampleChannel(WhenFull when_full);

  /// Producer.
  void on_sample(const core::Sample& sample) override;
  void on_gap() override;
  void on_reading(const core::OdometryReading& reading) override;

  /// Consumer.
  bool pop(Item& item) { return ring_.pop(item); }
  std::uint32_t wakes() const { return wakes_.load(std::memory_order_acquire); }
  /// Sleeps until wakes() is no longer `seen`. Take `seen` before the last pop() that failed.
  void wait(std::uint32_t seen) const { wakes_.wait(seen, std::memory_order_acquire); }

  /// Any thread.
  void wake();
  /// Ends all waiting of the producer; what it still brings is lost.
  void close();
  /// The time of the newest sample that the producer brought; 0 before the first one.
  core::TimeNs newest_ns() const { return newest_ns_.load(std::memory_order_relaxed); }
  std::uint64_t lost() const { return lost_.load(std::memory_order_relaxed); }
  /// Of the producer's thread, as of the last turn's beginning.
  std::uint64_t producer_page_faults() const {
    return page_faults_.load(std::memory_order_relaxed);
  }

 private:
  bool push(const Item& item);

  const WhenFull when_full_;
  core::RingBuffer<Item> ring_;
  std::uint32_t since_wake_ = 0;
  bool gap_pending_ = false;  ///< samples were lost, and the consumer does not know yet
  std::atomic<std::uint32_t> wakes_{0};
  std::atomic<core::TimeNs> newest_ns_{0};
  std::atomic<std::uint32_t> lost_{0};
  std::atomic<std::uint32_t> page_faults_{0};
  std::atomic<bool> closed_{false};
};

}  // namespace cornerd::daemon
