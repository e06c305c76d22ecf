// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "drivers/rplidar/decoder.hpp"
#include "drivers/rplidar/wire/byte_window.hpp"
#include "drivers/rplidar/wire/capsule.hpp"
#include "drivers/rplidar/wire/capsule_cadence.hpp"
#include "drivers/rplidar/wire/standard_decoder.hpp"

namespace cornerd::rplidar {

/// Express and ultra capsules. A capsule says where its first sample points; where the last one
/// does, only the next capsule tells: each waits for its successor. Where that one is lost or
/// damaged the one after it tells as well; where more are missing, or a stream began anew, it is
/// given up.
class CapsuleDecoder {
 public:
  explicit CapsuleDecoder(drivers::StreamCounters& counters) : counters_(&counters) {}

  /// A capsule begins at the window's front. `same_stream`: the one before was lost track of within
  /// a stream; the speed and the place in the turn still hold.
  void lock(WireFormat format, bool same_stream);
  Step step(ByteWindow& window, std::uint64_t& index, RawSampleSink& sink);
  /// Gives up the capsule that waits: the stream has ended, or another one begins.
  void drop_waiting(std::uint64_t& index);

 private:
  void pair(std::span<const std::uint8_t> next, std::uint64_t& index, RawSampleSink& sink);
  /// `next`: the capsule after the waiting one; empty where it is missing.
  void decode_waiting(std::span<const std::uint8_t> next, int diff_q6, std::uint64_t index,
                      RawSampleSink& sink);

  drivers::StreamCounters* counters_;
  WireFormat format_ = WireFormat::kExpress;
  CapsuleCadence cadence_;
  std::array<std::uint8_t, kUltraSize> waiting_{};
  bool has_waiting_ = false;
  bool followed_at_once_ = true;  ///< no byte was skipped since the waiting capsule
  int damaged_ = 0;               ///< capsules with a bad checksum since then
  bool scan_began_in_gap_ = false;
};

}  // namespace cornerd::rplidar
