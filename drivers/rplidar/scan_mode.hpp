// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "drivers/rplidar/decoder.hpp"
#include "drivers/rplidar/protocol/descriptor.hpp"
#include "drivers/rplidar/protocol/request.hpp"

namespace cornerd::rplidar {

/// A way of measuring that a device offers.
struct ScanMode {
  std::uint16_t id = 0;
  std::string name;
  WireFormat format = WireFormat::kStandard;
  double period_s = 0;  ///< a sample; 0: not known

  /// What starts it: SCAN where it answers in standard nodes, else EXPRESS_SCAN.
  Request request() const;
};

/// nullopt for answers that an A1 does not give.
std::optional<WireFormat> wire_format(AnswerType type);

/// The mode to use. `wanted`: "auto" or a name, in any case. Auto prefers express: it measures
/// twice as often as standard, and finer beyond half a metre than the ultra modes, whose distances
/// are rounded to 2 to 16 mm there. Null where the device has no such mode.
const ScanMode* choose_mode(std::span<const ScanMode> modes, std::string_view wanted);

/// "Standard, Express, Boost".
std::string list_names(std::span<const ScanMode> modes);

}  // namespace cornerd::rplidar
