// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "drivers/rplidar/decoder.hpp"
#include "drivers/rplidar/protocol/framing.hpp"

namespace cornerd::rplidar {

/// A scan mode that a device offers.
struct ScanMode {
  std::uint16_t id = 0;
  std::string name;
  WireFormat format = WireFormat::kStandard;
  double period_s = 0;  ///< per sample; 0: not known

  /// SCAN for standard nodes, else EXPRESS_SCAN.
  Request request() const;
};

/// nullopt for other answers.
std::optional<WireFormat> wire_format(AnswerType type);

/// `wanted`: "auto" or a name, case-insensitive; null if there is no such mode. Auto prefers
/// express and dense: a checksum, which standard nodes lack, and millimetres, where ultra rounds to
/// 2 to 16 mm beyond 0.5 m.
const ScanMode* choose_mode(std::span<const ScanMode> modes, std::string_view wanted);

/// "Standard, Express, Boost".
std::string list_names(std::span<const ScanMode> modes);

}  // namespace cornerd::rplidar
