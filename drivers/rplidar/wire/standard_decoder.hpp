// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>

#include "drivers/rplidar/decoder.hpp"
#include "drivers/rplidar/wire/byte_window.hpp"
#include "drivers/rplidar/wire/node_revolutions.hpp"
#include "drivers/rplidar/wire/node_track.hpp"

namespace cornerd::rplidar {

/// What a format's decoder made of the next bytes.
enum class Step : std::uint8_t {
  kMore,      ///< needs more bytes
  kProgress,  ///< took something out of the window
  kLost,      ///< no packet of the format follows: search
};

/// Standard nodes, once their boundary is known. A node stays at the front of the window until the
/// next one has confirmed it: a lost byte gives its node a piece of the successor as distance, and
/// only the successor shows it.
class StandardDecoder {
 public:
  explicit StandardDecoder(drivers::StreamCounters& counters) : counters_(&counters) {}

  /// The window's front is where a node begins: a descriptor ended there, or a chain was found.
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
  NodeTrack track_;
  NodeRevolutions scans_;
  StandardNode front_;  ///< of the window; part of the track already
  bool front_starts_scan_ = false;
  std::size_t confirmed_ = 0;      ///< nodes since the lock
  bool has_front_ = false;         ///< else the first node after the lock is still to come
  std::size_t search_offset_ = 0;  ///< of a relock in progress; 0: none
};

}  // namespace cornerd::rplidar
