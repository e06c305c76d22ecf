// SPDX-License-Identifier: MIT
#include "drivers/rplidar/scan_mode.hpp"

#include <algorithm>
#include <cctype>

namespace cornerd::rplidar {
namespace {

bool same_name(std::string_view a, std::string_view b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](unsigned char x, unsigned char y) {
    return std::tolower(x) == std::tolower(y);
  });
}

const ScanMode* first_with(std::span<const ScanMode> modes, WireFormat format) {
  const auto found = std::find_if(modes.begin(), modes.end(),
                                  [&](const ScanMode& mode) { return mode.format == format; });
  return found == modes.end() ? nullptr : &*found;
}

}  // namespace

Request ScanMode::request() const {
  return format == WireFormat::kStandard ? Request(Command::kScan)
                                         : Request::express_scan(static_cast<std::uint8_t>(id));
}

std::optional<WireFormat> wire_format(AnswerType type) {
  switch (type) {
    case AnswerType::kStandardScan:
      return WireFormat::kStandard;
    case AnswerType::kExpressScan:
      return WireFormat::kExpress;
    case AnswerType::kUltraScan:
      return WireFormat::kUltra;
    case AnswerType::kDenseScan:
      return WireFormat::kDense;
    case AnswerType::kUltraDenseScan:
      return WireFormat::kUltraDense;
    case AnswerType::kHqScan:
      return WireFormat::kHq;
    default:
      return std::nullopt;
  }
}

const ScanMode* choose_mode(std::span<const ScanMode> modes, std::string_view wanted) {
  if (same_name(wanted, "auto")) {
    for (const WireFormat format :
         {WireFormat::kExpress, WireFormat::kDense, WireFormat::kUltraDense, WireFormat::kStandard,
          WireFormat::kHq, WireFormat::kUltra}) {
      if (const ScanMode* mode = first_with(modes, format)) return mode;
    }
    return nullptr;
  }
  const auto found = std::find_if(modes.begin(), modes.end(), [&](const ScanMode& mode) {
    return same_name(mode.name, wanted);
  });
  return found == modes.end() ? nullptr : &*found;
}

std::string list_names(std::span<const ScanMode> modes) {
  std::string names;
  for (const ScanMode& mode : modes) names += (names.empty() ? "" : ", ") + mode.name;
  return names;
}

}  // namespace cornerd::rplidar
