// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>

#include "drivers/rplidar/decoder.hpp"
#include "drivers/rplidar/wire/byte_window.hpp"
#include "drivers/rplidar/wire/standard_node.hpp"

namespace cornerd::rplidar {

/// Decodes standard nodes of known boundary. A node is delivered when its successor confirms it:
/// after a lost byte its distance holds bytes of the successor.
class StandardDecoder {
 public:
  explicit StandardDecoder(drivers::StreamCounters& counters) : counters_(&counters) {}

  /// A node begins at the window's front.
  void lock();
  Step step(ByteWindow& window, std::uint64_t& index, bool final, RawSampleSink& sink);

 private:
  Step begin(ByteWindow& window);
  Step relock(ByteWindow& window, std::uint64_t& index, bool final, RawSampleSink& sink);
  Step end(ByteWindow& window, std::uint64_t& index, RawSampleSink& sink);
  void advance(const StandardNode& node, int periods);
  void deliver_front(ByteWindow& window, std::uint64_t index, RawSampleSink& sink);
  void skip(ByteWindow& window, std::size_t count);

  drivers::StreamCounters* counters_;
  HeadAngleFilter track_;
  ScanSplitter scans_;
  StandardNode front_;  ///< of the window; track_ includes it
  bool front_starts_scan_ = false;
  std::size_t confirmed_ = 0;      ///< nodes since the lock
  bool has_front_ = false;         ///< false until the first node after the lock
  std::size_t search_offset_ = 0;  ///< of a relock in progress; 0: none
};

}  // namespace cornerd::rplidar
