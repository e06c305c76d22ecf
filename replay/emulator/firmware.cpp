// SPDX-License-Identifier: MIT
#include "replay/emulator/firmware.hpp"

#include <array>

#include "drivers/rplidar/protocol/answers.hpp"

namespace cornerd::replay {
namespace {

using rplidar::WireFormat;

constexpr std::uint32_t k12MetresQ8 = 12 << 8;
constexpr std::uint32_t k16MetresQ8 = 16 << 8;
constexpr std::uint32_t k25MetresQ8 = 25 << 8;
constexpr std::uint32_t k30MetresQ8 = 30 << 8;
constexpr std::uint32_t k40MetresQ8 = 40 << 8;

// Answers of a real device: 508, 254, 127, 127, 201 us.
constexpr std::array<FirmwareScanMode, 5> kModes129 = {{
    {"Standard", 130048, k12MetresQ8, 0x81, WireFormat::kStandard},
    {"Express", 65024, k12MetresQ8, 0x82, WireFormat::kExpress},
    {"Boost", 32512, k12MetresQ8, 0x84, WireFormat::kUltra},
    {"Sensitivity", 32512, k12MetresQ8, 0x84, WireFormat::kUltra},
    {"Stability", 51456, k12MetresQ8, 0x84, WireFormat::kUltra},
}};

constexpr std::array<FirmwareScanMode, 3> kModes124 = {{
    {"Standard", 500 << 8, k12MetresQ8, 0x81, WireFormat::kStandard},
    {"Express", 250 << 8, k12MetresQ8, 0x82, WireFormat::kExpress},
    {"Boost", 125 << 8, k12MetresQ8, 0x84, WireFormat::kUltra},
}};

// 2,000, 4,000, 8,000 and 5,000 samples a second, as the data sheet has it.
constexpr std::array<FirmwareScanMode, 5> kModesA2M8 = {{
    {"Standard", 504 << 8, k12MetresQ8, 0x81, WireFormat::kStandard},
    {"Express", 252 << 8, k12MetresQ8, 0x82, WireFormat::kExpress},
    {"Boost", 126 << 8, k12MetresQ8, 0x84, WireFormat::kUltra},
    {"Sensitivity", 126 << 8, k12MetresQ8, 0x84, WireFormat::kUltra},
    {"Stability", 200 << 8, k12MetresQ8, 0x84, WireFormat::kUltra},
}};

// A real A3's: 4.0, 7.9, 15.9, 15.9 and 10.0 thousand a second, 25 m.
constexpr std::array<FirmwareScanMode, 5> kModesA3 = {{
    {"Standard", 252 << 8, k25MetresQ8, 0x81, WireFormat::kStandard},
    {"Express", 126 << 8, k25MetresQ8, 0x82, WireFormat::kExpress},
    {"Boost", 63 << 8, k25MetresQ8, 0x84, WireFormat::kUltra},
    {"Sensitivity", 63 << 8, k25MetresQ8, 0x84, WireFormat::kUltra},
    {"Stability", 100 << 8, k25MetresQ8, 0x84, WireFormat::kUltra},
}};

constexpr std::array<FirmwareScanMode, 5> kModesA2M12 = {{
    {"Standard", 252 << 8, k12MetresQ8, 0x81, WireFormat::kStandard},
    {"Express", 126 << 8, k12MetresQ8, 0x82, WireFormat::kExpress},
    {"Boost", 63 << 8, k12MetresQ8, 0x84, WireFormat::kUltra},
    {"Sensitivity", 63 << 8, k12MetresQ8, 0x84, WireFormat::kUltra},
    {"Stability", 100 << 8, k12MetresQ8, 0x84, WireFormat::kUltra},
}};

constexpr std::array<FirmwareScanMode, 2> kModesC1 = {{
    {"Standard", 200 << 8, k16MetresQ8, 0x81, WireFormat::kStandard},
    {"DenseBoost", 200 << 8, k40MetresQ8, 0x85, WireFormat::kDense},
}};

// Answers of a real device.
constexpr std::array<FirmwareScanMode, 2> kModesS1 = {{
    {"Standard", 244 << 8, k40MetresQ8, 0x81, WireFormat::kStandard},
    {"DenseBoost", 108 << 8, k40MetresQ8, 0x85, WireFormat::kDense},
}};

constexpr std::array<FirmwareScanMode, 2> kModesS2 = {{
    {"Standard", 16'000, k30MetresQ8, 0x81, WireFormat::kStandard},
    {"DenseBoost", 8'000, k30MetresQ8, 0x85, WireFormat::kDense},
}};

// The last two stand for firmwares whose tables are not published.
constexpr std::array<FirmwareScanMode, 4> kModesS3 = {{
    {"Standard", 16'000, k40MetresQ8, 0x81, WireFormat::kStandard},
    {"DenseBoost", 8'000, k40MetresQ8, 0x85, WireFormat::kDense},
    {"UltraDense", 8'000, k40MetresQ8, 0x86, WireFormat::kUltraDense},
    {"HQ", 100 << 8, k40MetresQ8, 0x83, WireFormat::kHq},
}};

constexpr std::array<Firmware, 10> kFirmwares = {{
    {"1.29", 1, 29, 7, 0x18, 508, 254, kModes129, 3,
     "RP LIDAR System.\r\nFirmware Ver 1.29 - rtm, HW Ver 7\r\nModel: 18\r\n"},
    {"1.24", 1, 24, 5, 0x18, 500, 250, kModes124, 2,
     "RP LIDAR System.\r\nFirmware Ver 1.24 - rtm, HW Ver 5\r\nModel: 18\r\n"},
    // A head of 2,000 samples/s gives no more in express mode.
    {"1.17",
     1,
     17,
     0,
     0x00,
     500,
     500,
     {},
     0,
     "RP LIDAR System.\r\nFirmware Ver 1.17, HW Ver 0\r\nMode: 0\r\n"},
    {"a2m8", 1, 29, 5, 0x28, 504, 252, kModesA2M8, 3,
     "RP LIDAR System.\r\nFirmware Ver 1.29 - rtm, HW Ver 5\r\nModel: 28\r\n", MotorRequests::kPwm},
    {"a2m12", 1, 32, 6, 0x2C, 252, 126, kModesA2M12, 3,
     "RP LIDAR System.\r\nFirmware Ver 1.32 - rtm, HW Ver 6\r\nModel: 2C\r\n", MotorRequests::kPwm},
    {"a3", 1, 29, 6, 0x31, 252, 126, kModesA3, 3,
     "RP LIDAR System.\r\nFirmware Ver 1.29 - rtm, HW Ver 6\r\nModel: 31\r\n", MotorRequests::kPwm},
    {"c1", 1, 2, 18, 0x41, 200, 200, kModesC1, 1, "", MotorRequests::kSpeed, 480, 720},
    {"s1", 1, 28, 18, 0x61, 244, 108, kModesS1, 1, "", MotorRequests::kSpeed, 480, 900},
    {"s2", 1, 2, 18, 0x71, 62, 31, kModesS2, 1, "", MotorRequests::kSpeed, 480, 900},
    {"s3", 1, 2, 18, 0x81, 62, 31, kModesS3, 1, "", MotorRequests::kSpeed, 480, 900},
}};

}  // namespace

const Firmware* find_firmware(std::string_view version) {
  for (const Firmware& firmware : kFirmwares) {
    if (firmware.version == version) return &firmware;
  }
  return nullptr;
}

FirmwareScanMode standard_mode(const Firmware& firmware) {
  if (!firmware.modes.empty()) return firmware.modes.front();
  return {"Standard", static_cast<std::uint32_t>(firmware.standard_us) << 8, k12MetresQ8, 0x81,
          WireFormat::kStandard};
}

std::optional<FirmwareScanMode> express_mode(const Firmware& firmware, std::uint8_t id) {
  if (id == 0) {
    if (firmware.measures_time_of_flight()) return std::nullopt;
    return FirmwareScanMode{"Express", static_cast<std::uint32_t>(firmware.express_us) << 8,
                            k12MetresQ8, 0x82, WireFormat::kExpress};
  }
  if (id >= firmware.modes.size()) return std::nullopt;
  return firmware.modes[id];
}

namespace {

using rplidar::ConfType;

void append(std::vector<std::uint8_t>& bytes, std::uint32_t value, int count) {
  for (int i = 0; i < count; ++i) bytes.push_back(static_cast<std::uint8_t>(value >> (8 * i)));
}

/// False if `entry` is no entry of a scan mode.
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
    case ConfType::kMinRotation:
    case ConfType::kMaxRotation:
      if (firmware.max_rpm == 0) return {};
      append(bytes, entry == ConfType::kMinRotation ? firmware.min_rpm : firmware.max_rpm, 2);
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
