// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "drivers/rplidar/decoder.hpp"
#include "drivers/rplidar/protocol/descriptor.hpp"
#include "drivers/rplidar/wire/byte_window.hpp"

namespace cornerd::rplidar {

struct DescriptorMatch {
  Verdict verdict = Verdict::kNo;
  /// Of a match; nullopt: a stream that no A1 sends (dense, HQ), recognised so that its packets are
  /// not taken for capsules, which they resemble.
  std::optional<WireFormat> format;
};

/// Whether `bytes` begin with the response descriptor of a measurement stream, all 7 bytes of it.
DescriptorMatch match_scan_descriptor(std::span<const std::uint8_t> bytes);

}  // namespace cornerd::rplidar
