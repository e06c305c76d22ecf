// SPDX-License-Identifier: MIT
#include "drivers/rplidar/wire/byte_window.hpp"

#include <algorithm>
#include <array>

namespace cornerd::rplidar {
namespace {

struct KnownDescriptor {
  std::array<std::uint8_t, kDescriptorSize> bytes;
  WireFormat format;
};

// A5 5A, packet size (30 bits), mode "many packets" (2 bits), type.
constexpr std::array kKnown{
    KnownDescriptor{{0xA5, 0x5A, 0x05, 0x00, 0x00, 0x40, 0x81}, WireFormat::kStandard},
    KnownDescriptor{{0xA5, 0x5A, 0x54, 0x00, 0x00, 0x40, 0x82}, WireFormat::kExpress},
    KnownDescriptor{{0xA5, 0x5A, 0x84, 0x00, 0x00, 0x40, 0x84}, WireFormat::kUltra},
    KnownDescriptor{{0xA5, 0x5A, 0x54, 0x00, 0x00, 0x40, 0x85}, WireFormat::kDense},
    KnownDescriptor{{0xA5, 0x5A, 0xAA, 0x00, 0x00, 0x40, 0x86}, WireFormat::kUltraDense},
    KnownDescriptor{{0xA5, 0x5A, 0x0D, 0x03, 0x00, 0x40, 0x83}, WireFormat::kHq},
};

}  // namespace

DescriptorMatch match_scan_descriptor(std::span<const std::uint8_t> bytes) {
  DescriptorMatch match;
  for (const KnownDescriptor& known : kKnown) {
    const std::size_t count = std::min(bytes.size(), kDescriptorSize);
    if (!std::equal(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(count),
                    known.bytes.begin())) {
      continue;
    }
    if (count == kDescriptorSize) return {Verdict::kYes, known.format};
    match.verdict = Verdict::kMore;
  }
  return match;
}

}  // namespace cornerd::rplidar
