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
/// second instead of one per sample, or one every 10 ms for partial scans. A stream without scan
/// starts wakes it every kWakeInterval samples, before the ring is full.
class SampleChannel final : public drivers::SampleSink {
 public:
  enum class Kind : std::uint8_t { kSample, kGap, kReading };
  struct Item {
    core::Sample sample;
    core::OdometryReading reading;
    /// Of the last byte, monotonic; 0 for a sample inside a scan.
    std::int64_t arrival_ns = 0;
    std::int64_t passed_ns = 0;  ///< when it was put into the channel; 0 likewise
    Kind kind = Kind::kSample;
  };

  /// kLose (device): samples that do not fit are lost, counted and marked by a gap. kWait
  /// (recording): the producer waits.
  enum class WhenFull : std::uint8_t { kLose, kWait };
  explicit SampleChannel(WhenFull when_full);

  /// Producer.
  void on_sample(const core::Sample& sample) override;
  void on_arrival(core::TimeNs arrival_ns) override { arrival_ns_ = arrival_ns; }
  void on_gap() override;
  void on_reading(const core::OdometryReading& reading) override;

  /// Consumer.
  bool pop(Item& item) { return ring_.pop(item); }
  std::uint32_t wakes() const { return wakes_.load(std::memory_order_acquire); }
  /// Sleeps until wakes() differs from `seen`. Read `seen` before the last failed pop().
  void wait(std::uint32_t seen) const { wakes_.wait(seen, std::memory_order_acquire); }

  /// Any thread.
  void wake();
  /// Wakes the consumer within scans too.
  void wake_for_parts(bool parts) { wakes_for_parts_.store(parts, std::memory_order_relaxed); }
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
  core::TimeNs woken_ns_ = 0;    ///< time of the sample of the last wake-up
  std::int64_t arrival_ns_ = 0;  ///< of the next sample; 0 if the source does not say
  bool gap_pending_ = false;     ///< samples were lost and the gap is not yet in the ring
  std::atomic<bool> wakes_for_parts_{false};
  std::atomic<std::uint32_t> wakes_{0};
  std::atomic<core::TimeNs> newest_ns_{0};
  std::atomic<std::uint32_t> lost_{0};
  std::atomic<std::uint32_t> page_faults_{0};
  std::atomic<bool> closed_{false};
};

}  // namespace cornerd::daemon
