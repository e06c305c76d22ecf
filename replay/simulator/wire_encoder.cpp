// SPDX-License-Identifier: MIT
#include "replay/simulator/wire_encoder.hpp"

#include <algorithm>

namespace cornerd::replay {
namespace {

constexpr std::uint8_t low_byte(std::uint32_t value) { return static_cast<std::uint8_t>(value); }

/// Writes the first four bytes; the checksum covers the rest, which must be complete.
void write_capsule_header(std::uint16_t start_angle_q6, bool restart,
                          std::span<std::uint8_t> capsule) {
  capsule[2] = low_byte(start_angle_q6);
  capsule[3] = low_byte((start_angle_q6 >> 8 & 0x7F) | (restart ? 0x80u : 0u));
  std::uint8_t checksum = 0;
  for (const std::uint8_t byte : capsule.subspan(2)) checksum ^= byte;
  capsule[0] = low_byte(0xA0u | (checksum & 0x0Fu));
  capsule[1] = low_byte(0x50u | (checksum >> 4));
}

/// A 12-bit floating-point code and its decoded distance.
struct MajorCode {
  std::uint32_t code = 0;
  std::uint32_t mm = 0;
  unsigned level = 0;
};

MajorCode major_code(std::uint32_t dist_mm) {
  struct Step {
    std::uint32_t first_mm;
    std::uint32_t first_code;
    unsigned level;
  };
  static constexpr std::array<Step, 5> kSteps{
      {{16384, 3328, 4}, {4096, 1792, 3}, {2048, 1280, 2}, {512, 512, 1}, {0, 0, 0}}};
  for (const Step& step : kSteps) {
    if (dist_mm < step.first_mm) continue;
    const std::uint32_t code =
        std::min(step.first_code + ((dist_mm - step.first_mm) >> step.level), 4095u);
    return {code, step.first_mm + ((code - step.first_code) << step.level), step.level};
  }
  return {};
}

/// Difference to a coded neighbour: 10 bits; -512 and 511 are invalid.
struct Prediction {
  std::uint32_t bits = 0x200;
  std::uint32_t mm = 0;
};

Prediction prediction(std::uint32_t dist_mm, const MajorCode& base) {
  if (dist_mm == 0) return {};
  const std::int32_t difference =
      (static_cast<std::int32_t>(dist_mm) - static_cast<std::int32_t>(base.mm)) >> base.level;
  const std::int32_t carried = static_cast<std::int32_t>(base.mm) + difference * (1 << base.level);
  if (difference <= -512 || difference >= 511 || carried <= 0) return {};
  return {static_cast<std::uint32_t>(difference) & 0x3FFu, static_cast<std::uint32_t>(carried)};
}

}  // namespace

DescriptorBytes scan_descriptor(rplidar::WireFormat format) {
  const auto descriptor = [](std::uint32_t size, std::uint8_t type) {
    return DescriptorBytes{0xA5, 0x5A, low_byte(size), low_byte(size >> 8), 0, 0x40, type};
  };
  switch (format) {
    case rplidar::WireFormat::kStandard:
      break;
    case rplidar::WireFormat::kExpress:
      return descriptor(84, 0x82);
    case rplidar::WireFormat::kUltra:
      return descriptor(132, 0x84);
    case rplidar::WireFormat::kDense:
      return descriptor(84, 0x85);
    case rplidar::WireFormat::kUltraDense:
      return descriptor(170, 0x86);
    case rplidar::WireFormat::kHq:
      return descriptor(781, 0x83);
  }
  return descriptor(5, 0x81);
}

NodeBytes encode_node(bool starts_scan, std::uint8_t quality, std::uint16_t angle_q6,
                      std::uint16_t dist_q2) {
  const std::uint32_t angle = static_cast<std::uint32_t>(angle_q6) << 1 | 1u;
  return {low_byte((starts_scan ? 1u : 2u) | static_cast<std::uint32_t>(quality) << 2),
          low_byte(angle), low_byte(angle >> 8), low_byte(dist_q2), low_byte(dist_q2 >> 8u)};
}

ExpressBytes encode_express(std::uint16_t start_angle_q6, bool restart,
                            std::span<const ExpressSample, kExpressSamples> samples) {
  ExpressBytes bytes{};
  for (std::size_t cabin = 0; cabin < kExpressSamples / 2; ++cabin) {
    const ExpressSample& one = samples[2 * cabin];
    const ExpressSample& two = samples[2 * cabin + 1];
    const std::uint32_t a = static_cast<std::uint32_t>(one.dist_mm) << 2 | one.offset_q3 >> 4;
    const std::uint32_t b = static_cast<std::uint32_t>(two.dist_mm) << 2 | two.offset_q3 >> 4;
    std::uint8_t* out = bytes.data() + 4 + 5 * cabin;
    out[0] = low_byte(a);
    out[1] = low_byte(a >> 8);
    out[2] = low_byte(b);
    out[3] = low_byte(b >> 8);
    out[4] = low_byte((two.offset_q3 & 0x0Fu) << 4 | (one.offset_q3 & 0x0Fu));
  }
  write_capsule_header(start_angle_q6, restart, bytes);
  return bytes;
}

UltraCapsule encode_ultra(std::uint16_t start_angle_q6, bool restart,
                          std::span<const std::uint32_t, kUltraSamples + 1> dist_mm) {
  UltraCapsule capsule;
  for (std::size_t cabin = 0; cabin < kUltraSamples / 3; ++cabin) {
    const std::size_t k = 3 * cabin;
    const MajorCode own = major_code(dist_mm[k]);
    const MajorCode next = major_code(dist_mm[k + 3]);
    const Prediction one = prediction(dist_mm[k + 1], own.mm != 0 ? own : next);
    const Prediction two = prediction(dist_mm[k + 2], next);
    const std::uint32_t word = own.code | one.bits << 12 | two.bits << 22;
    for (std::size_t i = 0; i < 4; ++i) {
      capsule.bytes[4 + 4 * cabin + i] = low_byte(word >> (8 * i));
    }
    capsule.carried_mm[k] = own.mm;
    capsule.carried_mm[k + 1] = one.mm;
    capsule.carried_mm[k + 2] = two.mm;
  }
  write_capsule_header(start_angle_q6, restart, capsule.bytes);
  return capsule;
}

}  // namespace cornerd::replay
