// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>

#include "drivers/stream/byte_window.hpp"
#include "drivers/stream/frame_decoder.hpp"
#include "drivers/stream/revolution_mark.hpp"
#include "drivers/ydlidar/ydlidar_packet.hpp"

namespace cornerd::ydlidar {

/// Bytes of a YDLIDAR X2 or X4 to samples. A damaged packet costs itself alone. Packets have no
/// number: missing ones are counted by the angle.
class YdlidarDecoder : public drivers::FrameDecoder {
 public:
  void feed(std::span<const std::uint8_t> bytes, drivers::FrameSink& sink) override;
  void finish(drivers::FrameSink& sink) override;
  /// An X4's, until a packet tells a rate that is an X2's.
  drivers::FrameTiming timing() const override;
  const drivers::StreamCounters& counters() const override { return counters_; }

 private:
  bool step(bool final, drivers::FrameSink& sink);
  bool skip(std::size_t count);
  bool step_packet(std::span<const std::uint8_t> bytes, bool final, drivers::FrameSink& sink);
  void decode(const Packet& packet, drivers::FrameSink& sink);
  void count_missing(const Packet& packet, drivers::FrameSink& sink);

  drivers::ByteWindow window_;
  drivers::StreamCounters counters_;
  drivers::RevolutionMark revolution_;
  bool locked_ = false;  ///< a packet begins at the window's front
  bool has_last_ = false;
  float last_deg_ = 0;    ///< of the last sample
  float step_deg_ = 0;    ///< between samples; 0: not known
  bool damaged_ = false;  ///< a packet with a wrong check code came since the last right one
  std::uint64_t index_ = 0;
  std::size_t packet_samples_ = 1;
  std::size_t delivered_ = 0;  ///< of the packet being delivered
  double period_s_ = kPeriodX4S;
};

}  // namespace cornerd::ydlidar
