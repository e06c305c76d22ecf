// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "replay/emulator/packet_emulator.hpp"

namespace cornerd::replay {

/// YDLIDAR X4 (requests) and X2 (sends as soon as it has power) by their development manuals.
class YdlidarEmulator : public PacketEmulator {
 public:
  /// `takes_requests`: an X4.
  YdlidarEmulator(PacketSimulator simulator, std::uint32_t baud, bool takes_requests);

  /// The optics of both.
  static constexpr Triangulation kOptics = {.offset_mm = 21.8, .crossing_mm = 155.3};

 private:
  core::TimeNs make_packet(PacketSimulator& simulator, std::vector<std::uint8_t>& out) override;
  void handle(std::uint8_t byte, core::TimeNs now_ns) override;
  void answer(std::uint8_t request, core::TimeNs now_ns);

  bool takes_requests_;
  bool in_request_ = false;
  std::int64_t revolution_ = -1;  ///< of the last packet; the first one at the zero mark is 0
};

}  // namespace cornerd::replay
