// SPDX-License-Identifier: MIT
// Any bytes from a YDLIDAR's port: its driver keeps running and stops when requested. The first
// byte selects the size of reads; the other bytes are what each request and each pause brings.
#include <algorithm>
#include <cstdlib>
#include <memory>
#include <span>
#include <stop_token>
#include <utility>

#include "drivers/stream/stream_driver.hpp"
#include "drivers/ydlidar/ydlidar_protocol.hpp"
#include "replay/emulator/virtual_clock.hpp"

namespace {

using namespace cornerd;

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
    return {ReadStatus::kData, count};
  }
  bool write(std::span<const std::uint8_t>) override {
    rest_ = input_;
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

class NoSink : public drivers::SampleSink {
 public:
  void on_sample(const core::Sample& sample) override {
    if (!(sample.range_m >= 0)) std::abort();
  }
  void on_gap() override {}
};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  replay::VirtualClock clock;
  std::stop_source stop;
  int sessions = 0;
  const auto open = [&](std::uint32_t) -> drivers::OpenResult {
    if (++sessions == 4) stop.request_stop();
    return {
        std::make_unique<AnyPort>(std::span(data + 1, size - 1), std::size_t{data[0]} + 1, clock),
        drivers::OpenError::kNone,
        {}};
  };
  drivers::StreamDriver driver({"/dev/any", {128'000, 115'200}, false},
                               std::make_unique<ydlidar::YdlidarProtocol>(true), open, clock);
  NoSink sink;
  driver.run(stop.get_token(), sink);
  const drivers::StreamCounters counters = driver.status().counters;
  if (counters.used_bytes + counters.skipped_bytes != counters.bytes) std::abort();
  return 0;
}
