// SPDX-License-Identifier: MIT
#include "replay/emulator/ld_emulator.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace cornerd::replay {
namespace {

// The manual's packet: 12 samples of 3 bytes in a frame of 11.
constexpr int kSamples = 12;
constexpr std::uint8_t kConfidence = 200;  // of a return indoors; the recordings have 180 to 250

void put_word(std::vector<std::uint8_t>& out, std::int64_t value) {
  out.push_back(static_cast<std::uint8_t>(value & 0xFF));
  out.push_back(static_cast<std::uint8_t>(value >> 8 & 0xFF));
}

std::int64_t wrapped(std::int64_t cdeg) { return (cdeg % 36'000 + 36'000) % 36'000; }

/// Bit by bit, polynomial 0x4D.
std::uint8_t check_byte(const std::vector<std::uint8_t>& bytes) {
  unsigned remainder = 0;
  for (const std::uint8_t byte : bytes) {
    remainder ^= byte;
    for (int i = 0; i < 8; ++i) {
      const bool carry = remainder >= 0x80;
      remainder = (remainder << 1 & 0xFF) ^ (carry ? 0x4DU : 0U);
    }
  }
  return static_cast<std::uint8_t>(remainder);
}

}  // namespace

LdEmulator::LdEmulator(PacketSimulator simulator, std::uint32_t baud)
    : PacketEmulator(std::move(simulator), baud) {
  start(0);
}

core::TimeNs LdEmulator::make_packet(PacketSimulator& simulator, std::vector<std::uint8_t>& out) {
  std::array<RotatingHead::Position, kSamples> heads;
  for (RotatingHead::Position& head : heads) head = simulator.next_head();
  const RotatingHead::Position& first = heads.front();
  const RotatingHead::Position& last = heads.back();
  const std::int64_t start_cdeg = std::llround(first.angle_deg * 100);
  const std::int64_t end_cdeg = std::llround(last.angle_deg * 100);
  const double speed_deg_s =
      (last.angle_deg - first.angle_deg) / core::to_seconds(last.t_ns - first.t_ns);

  out = {0x54, 0x2C};
  put_word(out, std::llround(speed_deg_s));
  put_word(out, wrapped(start_cdeg));
  for (int i = 0; i < kSamples; ++i) {
    // A host takes the samples to lie evenly between both angles.
    const double angle_deg =
        0.01 * (static_cast<double>(start_cdeg) +
                static_cast<double>(end_cdeg - start_cdeg) * i / (kSamples - 1));
    const double range_m = simulator.measure_m(heads[static_cast<std::size_t>(i)].t_ns, angle_deg);
    const std::int64_t dist_mm = std::clamp<std::int64_t>(std::llround(range_m * 1e3), 0, 0xFFFF);
    put_word(out, dist_mm);
    out.push_back(dist_mm > 0 ? kConfidence : std::uint8_t{0});
  }
  put_word(out, wrapped(end_cdeg));
  put_word(out, last.t_ns / 1'000'000 % 30'000);
  out.push_back(check_byte(out));
  return last.t_ns + simulator.period_ns();
}

}  // namespace cornerd::replay
