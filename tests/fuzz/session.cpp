// SPDX-License-Identifier: MIT
// Any bytes as answers: the driver keeps running, stops when requested, and accounts for every
// byte. The first byte selects the size of reads; the other bytes are the answer to every request.
#include <algorithm>
#include <cstdlib>
#include <limits>
#include <memory>
#include <span>
#include <stop_token>
#include <utility>

#include "drivers/rplidar/protocol/framing.hpp"
#include "drivers/rplidar/rplidar_driver.hpp"
#include "replay/emulator/virtual_clock.hpp"

namespace {

using namespace cornerd;

void require(bool condition) {
  if (!condition) std::abort();
}

/// Bytes read from the port, over all openings.
std::uint64_t read_bytes = 0;

class AnyPort : public drivers::ByteStream {
 public:
  AnyPort(std::span<const std::uint8_t> input, std::size_t portion, replay::VirtualClock& clock)
      : input_(input), portion_(portion), clock_(clock) {}

  ReadResult read(std::span<std::uint8_t> buffer, std::chrono::milliseconds timeout) override {
    if (rest_.empty()) {
      clock_.wait(timeout, {});
      return {};
    }
    clock_.wait(std::chrono::milliseconds(1), {});
    const std::size_t count = std::min({portion_, rest_.size(), buffer.size()});
    std::copy_n(rest_.begin(), count, buffer.begin());
    rest_ = rest_.subspan(count);
    read_bytes += count;
    return {ReadStatus::kData, count};
  }

  bool write(std::span<const std::uint8_t>) override {
    if (rest_.empty()) rest_ = input_;
    return true;
  }
  void discard_input() override { rest_ = {}; }
  bool set_dtr(bool) override { return true; }

 private:
  std::span<const std::uint8_t> input_;
  std::span<const std::uint8_t> rest_;
  std::size_t portion_;
  replay::VirtualClock& clock_;
};

class CountingSink : public drivers::SampleSink {
 public:
  void on_sample(const core::Sample& sample) override {
    require(sample.t_ns >= last_ns_);
    last_ns_ = sample.t_ns;
    ++samples;
  }
  /// The next session fits its clock anew.
  void on_gap() override { last_ns_ = kBefore; }
  std::uint64_t samples = 0;

 private:
  static constexpr core::TimeNs kBefore = std::numeric_limits<core::TimeNs>::min();
  core::TimeNs last_ns_ = kBefore;
};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  const std::span<const std::uint8_t> input(data + 1, size - 1);
  const std::size_t portion = 1 + data[0] % 128;
  constexpr core::TimeNs kDuration = 12 * core::kNsPerSecond;

  replay::VirtualClock clock;
  read_bytes = 0;
  rplidar::RplidarDriver driver(
      {.device = "port", .motor = {}},
      [&](std::uint32_t) -> drivers::OpenResult {
        return {std::make_unique<AnyPort>(input, portion, clock), drivers::OpenError::kNone, {}};
      },
      clock);
  std::stop_source stop;
  clock.set_on_advance([&](core::TimeNs now_ns) {
    if (now_ns >= kDuration) stop.request_stop();
    // The driver must stop within a second.
    require(now_ns < kDuration + core::kNsPerSecond);
  });
  CountingSink sink;
  driver.run(stop.get_token(), sink);

  const drivers::StreamCounters counters = driver.status().counters;
  require(counters.bytes == read_bytes);
  require(counters.used_bytes + counters.skipped_bytes == counters.bytes);
  require(counters.samples == sink.samples + counters.untimed_samples);
  return 0;
}
