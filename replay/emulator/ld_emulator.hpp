// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "replay/emulator/packet_emulator.hpp"

namespace cornerd::replay {

/// LD06, LD19, STL-19P, STL-27L by their development manuals: measures from time 0 on and ignores
/// what it receives.
class LdEmulator : public PacketEmulator {
 public:
  LdEmulator(PacketSimulator simulator, std::uint32_t baud);

 private:
  core::TimeNs make_packet(PacketSimulator& simulator, std::vector<std::uint8_t>& out) override;
};

}  // namespace cornerd::replay
