// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "drivers/rplidar/decoder.hpp"
#include "drivers/rplidar/wire/byte_window.hpp"
#include "drivers/rplidar/wire/capsule.hpp"
#include "drivers/rplidar/wire/standard_decoder.hpp"

namespace cornerd::rplidar {

/// Detects missing capsules by the steps between start angles, as capsules have no number. The
/// motor's speed changes little within 20 ms.
class CapsuleGapDetector {
 public:
  enum class Relation { kAdjacent, kGap, kUnknown };

  struct Result {
    Relation relation = Relation::kUnknown;
    int missing = 0;  ///< capsules; a lower bound if kUnknown
  };

  /// Another stream begins: forgets the speed.
  void reset(WireFormat format);

  /// `diff_q6`: angle between two capsules with `damaged_between` damaged ones between them.
  Result classify(int diff_q6, int damaged_between);

 private:
  void accept(int diff_q6);

  float step_q6_ = 0;  ///< 0: not known yet
  float first_limit_q6_ = 0;
  int rejected_q6_ = 0;
  int rejections_ = 0;
};

/// Decodes every format but standard nodes. A capsule holds the angle of its first sample only, so
/// each waits for its successor; HQ packets wait likewise, to tell a gap. If that one is lost, the
/// one after it gives the angle as well; if more are missing, or another stream begins, the capsule
/// is dropped.
class CapsuleDecoder {
 public:
  explicit CapsuleDecoder(drivers::StreamCounters& counters) : counters_(&counters) {}

  /// A capsule begins at the window's front. `same_stream`: angle and speed are still known.
  void lock(WireFormat format, bool same_stream);
  Step step(ByteWindow& window, std::uint64_t& index, RawSampleSink& sink);
  /// The stream has ended, or another one begins.
  void drop_pending(std::uint64_t& index);

 private:
  void pair(std::span<const std::uint8_t> next, std::uint64_t& index, RawSampleSink& sink);
  /// `next`: the capsule after the pending one; empty if missing.
  void decode_pending(std::span<const std::uint8_t> next, int diff_q6, std::uint64_t index,
                      RawSampleSink& sink);

  drivers::StreamCounters* counters_;
  WireFormat format_ = WireFormat::kExpress;
  CapsuleGapDetector gap_detector_;
  std::array<std::uint8_t, kMaxCapsuleSize> pending_{};
  bool has_pending_ = false;
  bool contiguous_ = true;  ///< no byte was skipped since the pending capsule
  int damaged_ = 0;         ///< capsules with a bad checksum since then
  bool scan_began_in_gap_ = false;
};

}  // namespace cornerd::rplidar
