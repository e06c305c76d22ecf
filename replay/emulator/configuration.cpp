// SPDX-License-Identifier: MIT
#include "replay/emulator/configuration.hpp"

#include "drivers/rplidar/protocol/answers.hpp"

namespace cornerd::replay {
namespace {

using rplidar::ConfType;

void append(std::vector<std::uint8_t>& bytes, std::uint32_t value, int count) {
  for (int i = 0; i < count; ++i) bytes.push_back(static_cast<std::uint8_t>(value >> (8 * i)));
}

/// False where the entry is none of a scan mode.
bool append_mode_entry(std::vector<std::uint8_t>& bytes, const FirmwareScanMode& mode,
                       ConfType entry) {
  switch (entry) {
    case ConfType::kModePeriod:
      append(bytes, mode.period_q8_us, 4);
      return true;
    case ConfType::kMaxDistance:
      append(bytes, mode.max_distance_q8_m, 4);
      return true;
    case ConfType::kAnswerType:
      append(bytes, mode.answer_type, 1);
      return true;
    case ConfType::kModeName:
      bytes.insert(bytes.end(), mode.name.begin(), mode.name.end());
      bytes.push_back(0);
      return true;
    default:
      return false;
  }
}

}  // namespace

std::vector<std::uint8_t> configuration_value(const Firmware& firmware,
                                              const std::optional<RotationTarget>& target,
                                              std::span<const std::uint8_t> request) {
  const std::optional<rplidar::ConfQuery> query = rplidar::ConfQuery::decode(request);
  if (!query || firmware.modes.empty()) return {};
  const auto entry = static_cast<ConfType>(query->type);
  std::vector<std::uint8_t> bytes;
  append(bytes, query->type, 4);
  switch (entry) {
    case ConfType::kDesiredRotation:
      if (!target) return {};
      append(bytes, target->rpm, 2);
      append(bytes, target->pwm, 2);
      return bytes;
    case ConfType::kModeCount:
      append(bytes, static_cast<std::uint32_t>(firmware.modes.size()), 2);
      return bytes;
    case ConfType::kTypicalMode:
      append(bytes, firmware.typical_mode, 2);
      return bytes;
    default:
      break;
  }
  if (!query->mode || *query->mode >= firmware.modes.size()) return {};
  if (!append_mode_entry(bytes, firmware.modes[*query->mode], entry)) return {};
  return bytes;
}

}  // namespace cornerd::replay
