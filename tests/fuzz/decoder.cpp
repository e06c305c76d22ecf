// SPDX-License-Identifier: MIT
// Any bytes, in any portions, give samples within the limits of the wire. The first byte selects
// the format and the size of the portions.
#include "drivers/rplidar/decoder.hpp"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <optional>
#include <span>

#include "drivers/rplidar/wire/standard_node.hpp"

namespace {

using namespace cornerd::rplidar;

void require(bool condition) {
  if (!condition) std::abort();
}

class CheckingSink : public RawSampleSink {
 public:
  void on_sample(const RawSample& sample) override {
    constexpr std::uint32_t kMaxDistanceQ2 = 400'000;  // HQ; any other has 65 m at most
    require(sample.angle_q6 < kFullRevolutionQ6);
    require(sample.dist_q2 <= kMaxDistanceQ2);
    require(!any_ || sample.index > last_index_);
    last_index_ = sample.index;
    any_ = true;
    ++samples_;
    // Half a revolution at 20 Hz is 49 nodes; a gap may shorten a scan.
    // An HQ packet's flags are its own.
    if (sample.starts_scan && since_start_ >= 0 && !is_hq) require(since_start_ >= 2);
    if (sample.starts_scan) since_start_ = 0;
    if (since_start_ >= 0) ++since_start_;
  }

  void on_gap() override { since_start_ = -1; }

  std::uint64_t samples() const { return samples_; }

  bool is_hq = false;

 private:
  bool any_ = false;
  std::uint64_t last_index_ = 0;
  std::uint64_t samples_ = 0;
  int since_start_ = -1;  ///< samples since the scan start; -1: no scan in progress
};

std::optional<WireFormat> format_of(unsigned choice) {
  constexpr std::array kFormats = {WireFormat::kStandard,   WireFormat::kExpress,
                                   WireFormat::kUltra,      WireFormat::kDense,
                                   WireFormat::kUltraDense, WireFormat::kHq};
  const unsigned index = choice / 128 * 3 + choice % 4;
  if (choice % 4 == 3) return std::nullopt;
  return kFormats[index];
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  const unsigned choice = data[0];
  const std::size_t portion = choice % 128 / 4 == 0 ? size : choice % 128 / 4;
  Decoder decoder(format_of(choice));
  CheckingSink sink;
  std::span<const std::uint8_t> bytes(data + 1, size - 1);
  while (!bytes.empty()) {
    const auto piece = bytes.first(std::min(portion, bytes.size()));
    decoder.feed(piece, sink);
    sink.is_hq = sink.is_hq || decoder.format() == WireFormat::kHq;
    bytes = bytes.subspan(piece.size());
  }
  decoder.finish(sink);

  const auto& counters = decoder.counters();
  require(counters.bytes == size - 1);
  require(counters.samples == sink.samples());
  require(counters.used_bytes + counters.skipped_bytes == counters.bytes);
  require(counters.scans <= counters.samples);
  return 0;
}
