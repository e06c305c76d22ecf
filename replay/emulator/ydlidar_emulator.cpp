// SPDX-License-Identifier: MIT
#include "replay/emulator/ydlidar_emulator.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace cornerd::replay {
namespace {

constexpr std::size_t kMaxSamples = 40;
constexpr core::TimeNs kTurnaroundNs = 1'000'000;

constexpr std::array<std::uint8_t, 7> kScanAnswer = {0xA5, 0x5A, 0x05, 0x00, 0x00, 0x40, 0x81};
// Model 6, firmware 1.10, hardware 1, a date as the serial number.
constexpr std::array<std::uint8_t, 27> kInfoAnswer = {
    0xA5, 0x5A, 0x14, 0x00, 0x00, 0x00, 0x04, 6, 10, 1, 1, 2, 0, 1,
    9,    0,    3,    0,    5,    0,    0,    0, 0,  0, 0, 1, 7};
constexpr std::array<std::uint8_t, 10> kHealthAnswer = {0xA5, 0x5A, 0x03, 0x00, 0x00,
                                                        0x00, 0x06, 0,    0,    0};

void put_word(std::vector<std::uint8_t>& out, std::uint32_t value) {
  out.push_back(static_cast<std::uint8_t>(value));
  out.push_back(static_cast<std::uint8_t>(value >> 8));
}

/// Degrees * 64 above the check bit.
std::uint32_t angle_word(double angle_deg) {
  const std::int64_t q6 = std::llround(angle_deg * 64) % (360 * 64);
  return static_cast<std::uint32_t>(q6 < 0 ? q6 + 360 * 64 : q6) << 1 | 1U;
}

std::int64_t revolution_of(const RotatingHead::Position& head) {
  return static_cast<std::int64_t>(std::floor(head.angle_deg / 360));
}

}  // namespace

YdlidarEmulator::YdlidarEmulator(PacketSimulator simulator, std::uint32_t baud, bool takes_requests)
    : PacketEmulator(std::move(simulator), baud), takes_requests_(takes_requests) {
  if (takes_requests_) return;
  send(0, kScanAnswer);
  start(0);
}

core::TimeNs YdlidarEmulator::make_packet(PacketSimulator& simulator,
                                          std::vector<std::uint8_t>& out) {
  const RotatingHead::Position head = simulator.next_head();
  const bool is_zero_packet = revolution_of(head) > revolution_;
  revolution_ = revolution_of(head);
  std::vector<RotatingHead::Position> heads = {head};
  while (!is_zero_packet && heads.size() < kMaxSamples &&
         revolution_of(simulator.head()) == revolution_) {
    heads.push_back(simulator.next_head());
  }

  const double first_deg = std::round(heads.front().angle_deg * 64) / 64;
  const double last_deg = std::round(heads.back().angle_deg * 64) / 64;
  std::vector<std::uint32_t> ranges;
  for (std::size_t i = 0; i < heads.size(); ++i) {
    // A host takes the samples to lie evenly between both angles.
    const double share =
        heads.size() > 1 ? static_cast<double>(i) / static_cast<double>(heads.size() - 1) : 0;
    const double range_m =
        simulator.measure_m(heads[i].t_ns, first_deg + (last_deg - first_deg) * share);
    ranges.push_back(static_cast<std::uint32_t>(
        std::clamp<std::int64_t>(std::llround(range_m * 4e3), 0, 0xFFFF)));
  }

  std::uint32_t type = is_zero_packet ? 1 : 0;
  if (is_zero_packet && !takes_requests_) {
    const RotatingHead::Position& next = simulator.head();
    const double rate_hz =
        (next.angle_deg - head.angle_deg) / 360 / core::to_seconds(next.t_ns - head.t_ns);
    type |= static_cast<std::uint32_t>(std::lround(rate_hz * 10)) << 1;
  }
  const std::uint32_t type_and_count = type | static_cast<std::uint32_t>(heads.size()) << 8;
  const std::uint32_t first = angle_word(heads.front().angle_deg);
  const std::uint32_t last = angle_word(heads.back().angle_deg);
  std::uint32_t check_code = 0x55AA ^ type_and_count ^ first ^ last;
  for (const std::uint32_t range : ranges) check_code ^= range;
  for (const std::uint32_t word : {0x55AAU, type_and_count, first, last, check_code}) {
    put_word(out, word);
  }
  for (const std::uint32_t range : ranges) put_word(out, range);
  return heads.back().t_ns + simulator.period_ns();
}

void YdlidarEmulator::handle(std::uint8_t byte, core::TimeNs now_ns) {
  if (!takes_requests_) return;
  if (in_request_) answer(byte, now_ns);
  in_request_ = !in_request_ && byte == 0xA5;
}

void YdlidarEmulator::answer(std::uint8_t request, core::TimeNs now_ns) {
  switch (request) {
    case 0x60:
      stop(now_ns);
      send(now_ns + kTurnaroundNs, kScanAnswer);
      start(now_ns + kTurnaroundNs);
      break;
    case 0x65:
    case 0x80:  // restart
      stop(now_ns);
      break;
    case 0x90:
      send(now_ns + kTurnaroundNs, kInfoAnswer);
      break;
    case 0x91:
    case 0x92:  // as the vendor's SDK asks
      send(now_ns + kTurnaroundNs, kHealthAnswer);
      break;
    default:
      break;
  }
}

}  // namespace cornerd::replay
