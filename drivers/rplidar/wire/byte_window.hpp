// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "drivers/rplidar/decoder.hpp"
#include "drivers/rplidar/protocol/framing.hpp"
#include "drivers/stream/byte_window.hpp"

namespace cornerd::rplidar {

using drivers::ByteWindow;

/// Whether the next bytes are a packet.
enum class Verdict : std::uint8_t {
  kNo,
  kYes,
  kMore,  ///< undecided: needs more bytes
};

/// What a format's decoder made of the next bytes.
enum class Step : std::uint8_t {
  kMore,      ///< needs more bytes
  kProgress,  ///< consumed bytes
  kLost,      ///< no packet of the format follows: search for one
};

struct DescriptorMatch {
  Verdict verdict = Verdict::kNo;
  WireFormat format = WireFormat::kStandard;
};

/// Whether `bytes` begin with the response descriptor of a scan, all 7 bytes of it.
DescriptorMatch match_scan_descriptor(std::span<const std::uint8_t> bytes);

}  // namespace cornerd::rplidar
