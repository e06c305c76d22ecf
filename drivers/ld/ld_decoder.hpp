// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>

#include "drivers/ld/ld_packet.hpp"
#include "drivers/stream/byte_window.hpp"
#include "drivers/stream/frame_decoder.hpp"
#include "drivers/stream/revolution_mark.hpp"

namespace cornerd::ld {

/// Bytes of an LDROBOT lidar to samples. A damaged packet costs itself alone: the next boundary is
/// searched byte by byte. Lost packets are counted by angle and the device's clock, so that the
/// samples' indices stay right.
class LdDecoder : public drivers::FrameDecoder {
 public:
  void feed(std::span<const std::uint8_t> bytes, drivers::FrameSink& sink) override;
  void finish(drivers::FrameSink& sink) override;
  drivers::FrameTiming timing() const override;
  const drivers::StreamCounters& counters() const override { return counters_; }

 private:
  bool step(bool final, drivers::FrameSink& sink);
  bool skip(std::size_t count);
  /// Whether a packet found in a search may be one: a random one of 256 has the right CRC.
  bool is_plausible(const Packet& packet) const;
  void decode(const Packet& packet, drivers::FrameSink& sink);
  void count_missing(const Packet& packet, drivers::FrameSink& sink);
  void deliver(const Packet& packet, drivers::FrameSink& sink);

  drivers::ByteWindow window_;
  drivers::StreamCounters counters_;
  drivers::RevolutionMark revolution_;
  bool locked_ = false;  ///< a packet begins at the window's front
  bool has_last_ = false;
  Packet last_;
  std::uint64_t damaged_ = 0;  ///< wrong CRCs since last_
  std::uint64_t index_ = 0;
  double period_s_ = 0;  ///< of the first packet's model; 0: none yet
};

}  // namespace cornerd::ld
