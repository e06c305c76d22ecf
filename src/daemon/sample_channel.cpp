// SPDX-License-Identifier: MIT
#include "daemon/sample_channel.hpp"

#include <chrono>
#include <thread>

#include "daemon/posix_clock.hpp"
#include "daemon/realtime.hpp"

namespace cornerd::daemon {
namespace {

/// Two seconds of an A1's fastest mode (8,000 samples per second), half a second of an S2's.
constexpr std::size_t kCapacity = 16384;
constexpr std::uint32_t kWakeInterval = 4096;
constexpr core::TimeNs kPartInterval_ns = 10'000'000;

/// Far shorter than the ring lasts at any playback speed.
constexpr std::chrono::milliseconds kRetryInterval{1};

}  // namespace

SampleChannel::SampleChannel(WhenFull when_full) : when_full_(when_full), ring_(kCapacity) {}

bool SampleChannel::push(const Item& item) { return ring_.push(item) || retry(item); }

bool SampleChannel::retry(const Item& item) {
  do {
    if (when_full_ == WhenFull::kLose || closed_.load(std::memory_order_relaxed)) return false;
    wake();
    std::this_thread::sleep_for(kRetryInterval);
  } while (!ring_.push(item));
  return true;
}

void SampleChannel::on_sample(const core::Sample& sample) {
  if (gap_pending_) on_gap();
  newest_ns_.store(sample.t_ns, std::memory_order_relaxed);
  const bool may_complete_scan = sample.starts_scan || sample.ends_scan;
  Item item{.sample = sample, .reading = {}, .kind = Kind::kSample};
  if (may_complete_scan) {
    item.passed_ns = monotonic_ns();
    item.arrival_ns = arrival_ns_ != 0 ? arrival_ns_ : item.passed_ns;
    arrival_ns_ = 0;
  }
  if (gap_pending_ || !push(item)) {
    gap_pending_ = true;
    lost_.fetch_add(1, std::memory_order_relaxed);
  }
  const bool is_part = wakes_for_parts_.load(std::memory_order_relaxed) &&
                       sample.t_ns - woken_ns_ >= kPartInterval_ns;
  if (may_complete_scan || is_part || ++since_wake_ >= kWakeInterval) {
    since_wake_ = 0;
    woken_ns_ = sample.t_ns;
    page_faults_.store(static_cast<std::uint32_t>(page_faults_of_thread()),
                       std::memory_order_relaxed);
    wake();
  }
}

void SampleChannel::on_gap() {
  const std::int64_t now_ns = monotonic_ns();
  gap_pending_ = !push(
      {.sample = {}, .reading = {}, .arrival_ns = now_ns, .passed_ns = now_ns, .kind = Kind::kGap});
  wake();
}

void SampleChannel::on_reading(const core::OdometryReading& reading) {
  // A lost reading does no harm: the next counts contain its motion.
  push({.sample = {}, .reading = reading, .kind = Kind::kReading});
}

void SampleChannel::wake() {
  wakes_.fetch_add(1, std::memory_order_release);
  wakes_.notify_one();
}

void SampleChannel::close() {
  closed_.store(true, std::memory_order_relaxed);
  wake();
}

}  // namespace cornerd::daemon
