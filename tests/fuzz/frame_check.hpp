// SPDX-License-Identifier: MIT
// What holds of every frame decoder, whatever it is fed.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <span>

#include "drivers/stream/frame_decoder.hpp"

namespace cornerd::fuzz {

inline void require(bool condition) {
  if (!condition) std::abort();
}

class CheckingSink : public drivers::FrameSink {
 public:
  explicit CheckingSink(const drivers::FrameDecoder& decoder) : decoder_(decoder) {}

  void on_sample(const drivers::FrameSample& sample) override {
    require(std::abs(sample.device_rad) < 3.1416F);
    require(sample.range_m >= 0 && sample.range_m < 66);
    require(samples_ == 0 || sample.index > last_index_);
    const drivers::FrameTiming timing = decoder_.timing();
    require(timing.period_s > 1e-5 && timing.period_s < 1e-2);
    require(timing.packet_bytes > 0 && timing.samples_ahead < 256);
    last_index_ = sample.index;
    ++samples_;
    if (sample.starts_scan) ++scans_;
  }
  void on_gap() override {}

  std::uint64_t samples() const { return samples_; }
  std::uint64_t scans() const { return scans_; }

 private:
  const drivers::FrameDecoder& decoder_;
  std::uint64_t last_index_ = 0;
  std::uint64_t samples_ = 0;
  std::uint64_t scans_ = 0;
};

/// The first byte is the size of the portions; 0: all at once.
inline void check(drivers::FrameDecoder& decoder, std::span<const std::uint8_t> input) {
  if (input.empty()) return;
  auto bytes = input.subspan(1);
  const std::size_t size = bytes.size();
  const std::size_t portion = input[0] == 0 ? size : input[0];
  CheckingSink sink(decoder);
  while (!bytes.empty()) {
    const auto piece = bytes.first(std::min(portion, bytes.size()));
    decoder.feed(piece, sink);
    bytes = bytes.subspan(piece.size());
  }
  decoder.finish(sink);
  const drivers::StreamCounters& counters = decoder.counters();
  require(counters.bytes == size);
  require(counters.used_bytes + counters.skipped_bytes == size);
  require(counters.samples == sink.samples());
  require(counters.scans == sink.scans());
}

}  // namespace cornerd::fuzz
