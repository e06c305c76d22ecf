// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "drivers/stream/frame_decoder.hpp"

namespace cornerd::frame_test {

using Bytes = std::vector<std::uint8_t>;

/// All that a decoder delivers.
class FrameCollector : public drivers::FrameSink {
 public:
  void on_sample(const drivers::FrameSample& sample) override { samples.push_back(sample); }
  void on_gap() override { gaps.push_back(samples.size()); }

  std::size_t scans() const {
    return static_cast<std::size_t>(std::count_if(
        samples.begin(), samples.end(), [](const auto& sample) { return sample.starts_scan; }));
  }

  std::vector<drivers::FrameSample> samples;
  std::vector<std::size_t> gaps;  ///< numbers of samples before them
};

/// Feeds all bytes in portions, then the end.
inline FrameCollector decode_all(drivers::FrameDecoder& decoder,
                                 std::span<const std::uint8_t> bytes, std::size_t portion = 4096) {
  FrameCollector collector;
  while (!bytes.empty()) {
    const auto piece = bytes.first(std::min(portion, bytes.size()));
    decoder.feed(piece, collector);
    bytes = bytes.subspan(piece.size());
  }
  decoder.finish(collector);
  return collector;
}

}  // namespace cornerd::frame_test
