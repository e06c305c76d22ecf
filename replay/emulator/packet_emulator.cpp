// SPDX-License-Identifier: MIT
#include "replay/emulator/packet_emulator.hpp"

#include <algorithm>

namespace cornerd::replay {
namespace {

/// If the caller stalls for longer, the stream restarts.
constexpr core::TimeNs kRestartAfterNs = core::kNsPerSecond;

}  // namespace

void PacketEmulator::receive(std::span<const std::uint8_t> bytes, core::TimeNs now_ns) {
  measure_until(now_ns);
  for (const std::uint8_t byte : bytes) handle(byte, now_ns);
}

void PacketEmulator::take(core::TimeNs now_ns, std::vector<std::uint8_t>& out) {
  measure_until(now_ns);
  transmitter_.take(now_ns, out);
}

std::optional<core::TimeNs> PacketEmulator::next_ns() const {
  const std::optional<core::TimeNs> sending_ns = transmitter_.next_ns();
  if (!measuring_ || stalled_) return sending_ns;
  return std::min(ready_ns_, sending_ns.value_or(ready_ns_));
}

void PacketEmulator::set_stalled(bool stalled, core::TimeNs now_ns) {
  measure_until(now_ns);
  if (stalled_ && !stalled && measuring_) start(now_ns);
  stalled_ = stalled;
}

void PacketEmulator::send(core::TimeNs ready_ns, std::span<const std::uint8_t> bytes) {
  transmitter_.queue(ready_ns, bytes);
}

void PacketEmulator::start(core::TimeNs now_ns) {
  measuring_ = true;
  simulator_.resume(now_ns);
  prepare();
}

void PacketEmulator::stop(core::TimeNs now_ns) {
  measuring_ = false;
  transmitter_.drop_unsent(now_ns);
}

void PacketEmulator::prepare() {
  packet_.clear();
  ready_ns_ = make_packet(simulator_, packet_);
}

void PacketEmulator::measure_until(core::TimeNs now_ns) {
  if (!measuring_ || stalled_) return;
  if (now_ns - ready_ns_ > kRestartAfterNs) start(now_ns);
  while (ready_ns_ <= now_ns) {
    transmitter_.queue(ready_ns_, packet_);
    prepare();
  }
}

}  // namespace cornerd::replay
