// SPDX-License-Identifier: MIT
#include "replay/emulator/firmware.hpp"

#include <array>

namespace cornerd::replay {
namespace {

using rplidar::WireFormat;

constexpr std::uint32_t k12MetresQ8 = 12 << 8;

// As a device of firmware 1.29 answered: 508, 254, 127, 127, 201 us.
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

constexpr std::array<Firmware, 3> kFirmwares = {{
    {"1.29", 1, 29, 7, 0x18, 508, 254, kModes129, 3,
     "RP LIDAR System.\r\nFirmware Ver 1.29 - rtm, HW Ver 7\r\nModel: 18\r\n"},
    {"1.24", 1, 24, 5, 0x18, 500, 250, kModes124, 2,
     "RP LIDAR System.\r\nFirmware Ver 1.24 - rtm, HW Ver 5\r\nModel: 18\r\n"},
    // A head of 2,000 samples a second gives no more of them in express mode.
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
}};

}  // namespace

const Firmware* find_firmware(std::string_view version) {
  for (const Firmware& firmware : kFirmwares) {
    if (firmware.version == version) return &firmware;
  }
  return nullptr;
}

FirmwareScanMode standard_mode(const Firmware& firmware) {
  return {"Standard", static_cast<std::uint32_t>(firmware.standard_us) << 8, k12MetresQ8, 0x81,
          WireFormat::kStandard};
}

std::optional<FirmwareScanMode> express_mode(const Firmware& firmware, std::uint8_t id) {
  if (id == 0) {
    return FirmwareScanMode{"Express", static_cast<std::uint32_t>(firmware.express_us) << 8,
                            k12MetresQ8, 0x82, WireFormat::kExpress};
  }
  if (id >= firmware.modes.size()) return std::nullopt;
  return firmware.modes[id];
}

}  // namespace cornerd::replay
