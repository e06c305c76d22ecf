// SPDX-License-Identifier: MIT
// Payloads of an RPLidar's single answers, to encode and to decode.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace cornerd::rplidar {

/// GET_INFO.
struct DeviceInfo {
  static constexpr std::size_t kSize = 20;

  std::uint8_t model = 0;      ///< series << 4 | version; 0x18: A1M8, 0x41: C1M1, 0x61: S1M1
  std::uint16_t firmware = 0;  ///< major << 8 | minor
  std::uint8_t hardware = 0;
  std::array<std::uint8_t, 16> serial{};

  bool operator==(const DeviceInfo&) const = default;

  std::array<std::uint8_t, kSize> encode() const;
  /// nullopt if there are too few bytes, as for the other answers.
  static std::optional<DeviceInfo> decode(std::span<const std::uint8_t> bytes);

  /// 1 to 3: A1 to A3, triangulation; 4: C1; 6 to 8: S1 to S3. The oldest A1s say 0.
  int series() const { return model >> 4; }
  bool measures_time_of_flight() const { return series() >= 4; }
  std::string model_name() const;     ///< "A1M8", as the vendor's SDK names it
  std::string firmware_text() const;  ///< "1.29"
  std::string serial_text() const;    ///< hexadecimal, in the order of the vendor's SDK
};

constexpr std::uint16_t firmware_version(int major, int minor) {
  return static_cast<std::uint16_t>(major << 8 | minor);
}

enum class HealthStatus : std::uint8_t { kGood = 0, kWarning = 1, kError = 2 };

/// GET_HEALTH.
struct Health {
  static constexpr std::size_t kSize = 3;

  std::uint8_t status = 0;  ///< HealthStatus
  std::uint16_t code = 0;   ///< undocumented

  bool failed() const { return status >= static_cast<std::uint8_t>(HealthStatus::kError); }
  std::array<std::uint8_t, kSize> encode() const;
  static std::optional<Health> decode(std::span<const std::uint8_t> bytes);
  std::string text() const;  ///< "good", "warning (code 0x0102)", "error (code 0x8001)"
};

/// GET_SAMPLERATE: microseconds per sample, firmware 1.17 and later.
struct SampleRate {
  static constexpr std::size_t kSize = 4;

  std::uint16_t standard_us = 0;
  std::uint16_t express_us = 0;

  std::array<std::uint8_t, kSize> encode() const;
  static std::optional<SampleRate> decode(std::span<const std::uint8_t> bytes);
  bool operator==(const SampleRate&) const = default;
};

/// GET_LIDAR_CONF: of an A series firmware 1.24 and later, of the others every one.
enum class ConfType : std::uint32_t {
  kDesiredRotation = 0x01,  ///< u16 revolutions per minute, u16 PWM of the accessory board
  kMinRotation = 0x04,      ///< u16 revolutions per minute
  kMaxRotation = 0x05,
  kModeCount = 0x70,    ///< u16
  kModePeriod = 0x71,   ///< u32, microseconds per sample in Q8
  kMaxDistance = 0x74,  ///< u32, metres in Q8
  kAnswerType = 0x75,   ///< u8
  kTypicalMode = 0x7C,  ///< u16
  kModeName = 0x7F,     ///< text that ends with a zero
};

/// The value of a configuration answer, after the echoed type.
struct ConfAnswer {
  std::uint32_t type = 0;
  std::span<const std::uint8_t> value;  ///< of the bytes decoded

  static std::optional<ConfAnswer> decode(std::span<const std::uint8_t> bytes);
  bool is(ConfType wanted) const { return type == static_cast<std::uint32_t>(wanted); }
  /// The value's first `size` bytes (at most 4), little-endian; nullopt if it has fewer.
  std::optional<std::uint32_t> number(std::size_t size) const;
  /// Up to the first zero.
  std::string_view text() const;
};

/// The request's payload, for the emulator.
struct ConfQuery {
  std::uint32_t type = 0;
  std::optional<std::uint16_t> mode;

  static std::optional<ConfQuery> decode(std::span<const std::uint8_t> payload);
};

}  // namespace cornerd::rplidar
