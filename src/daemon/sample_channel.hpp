// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <cstdint>

#include "core/ring_buffer.hpp"
#include "drivers/lidar_driver.hpp"

namespace cornerd::daemon {

/// Passes samples and gaps from the reader to the localizer, in order.
///
/// The localizer sleeps (std::atomic::wait) until a sample may complete a scan: a few wake-ups per
/// second instead of one per sample. A stream without scan starts wakes it every kWakeInterval
/// samples, before the ring is full.
class SampleChannel final : public drivers::SampleSink {
 public:
  enum class Kind : std::uint8_t { kSample, kGap, kReading };
  struct Item {
    core::Sample sample;
    core::OdometryReading reading;
    std::int64_t arrival_ns = 0;  ///< monotonic; 0 for a sample inside a scan
    Kind kind = Kind::kSample;
  };

  /// kLose (device): samples that do not fit are lost, counted and marked by a gap. kWait
  /// (recording): the producer waits.
  enum class WhenFull : std::uint8_t { kLose, kWait };
  explicit SampleChannel(WhenFull when_full);

  /// Producer.
  void on_sample(const core::Sample& sample) override;
  void on_gap() override;
  void on_reading(const core::OdometryReading& reading) override;

  /// Consumer.
  bool pop(Item& item) { return ring_.pop(item); }
  std::uint32_t wakes() const { return wakes_.load(std::memory_order_acquire); }
  /// Sleeps until wakes() differs from `seen`. Read `seen` before the last failed pop().
  void wait(std::uint32_t seen) const { wakes_.wait(seen, std::memory_order_acquire); }

  /// Any thread.
  void wake();
  /// Ends waiting of the producer; its further samples are lost.
  void close();
  /// Time of the producer's newest sample; 0 before the first.
  core::TimeNs newest_ns() const { return newest_ns_.load(std::memory_order_relaxed); }
  std::uint64_t lost() const { return lost_.load(std::memory_order_relaxed); }
  /// Of the producer thread, at the last start of a scan.
  std::uint64_t producer_page_faults() const {
    return page_faults_.load(std::memory_order_relaxed);
  }

 private:
  bool push(const Item& item);
  /// After a refused push: waits for room, or gives up.
  bool retry(const Item& item);

  const WhenFull when_full_;
  core::RingBuffer<Item> ring_;
  std::uint32_t since_wake_ = 0;
  bool gap_pending_ = false;  ///< samples were lost and the gap is not yet in the ring
  std::atomic<std::uint32_t> wakes_{0};
  std::atomic<core::TimeNs> newest_ns_{0};
  std::atomic<std::uint32_t> lost_{0};
  std::atomic<std::uint32_t> page_faults_{0};
  std::atomic<bool> closed_{false};
};

}  // namespace cornerd::daemon
