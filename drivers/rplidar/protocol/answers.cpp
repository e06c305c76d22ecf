// SPDX-License-Identifier: MIT
#include "drivers/rplidar/protocol/answers.hpp"

#include <algorithm>
#include <cstdio>

namespace cornerd::rplidar {
namespace {

std::uint16_t read_u16(std::span<const std::uint8_t> bytes) {
  return static_cast<std::uint16_t>(bytes[0] | bytes[1] << 8);
}

std::uint32_t read_u32(std::span<const std::uint8_t> bytes) {
  return read_u16(bytes) | static_cast<std::uint32_t>(read_u16(bytes.subspan(2))) << 16;
}

std::uint8_t low(std::uint16_t value) { return static_cast<std::uint8_t>(value); }
std::uint8_t high(std::uint16_t value) { return static_cast<std::uint8_t>(value >> 8); }

template <typename... Arguments>
std::string print(const char* format, Arguments... arguments) {
  std::array<char, 64> text{};
  std::snprintf(text.data(), text.size(), format, arguments...);
  return text.data();
}

}  // namespace

std::array<std::uint8_t, DeviceInfo::kSize> DeviceInfo::encode() const {
  std::array<std::uint8_t, kSize> bytes{model, low(firmware), high(firmware), hardware};
  std::copy(serial.begin(), serial.end(), bytes.begin() + 4);
  return bytes;
}

std::optional<DeviceInfo> DeviceInfo::decode(std::span<const std::uint8_t> bytes) {
  if (bytes.size() < kSize) return std::nullopt;
  DeviceInfo info{.model = bytes[0], .firmware = read_u16(bytes.subspan(1)), .hardware = bytes[3]};
  std::copy_n(bytes.begin() + 4, info.serial.size(), info.serial.begin());
  return info;
}

std::string DeviceInfo::model_name() const {
  if (model == 0) return "A1";
  struct Series {
    int first;
    char letter;
  };
  constexpr std::array<Series, 5> kSeries{{{12, 'M'}, {9, 'T'}, {6, 'S'}, {4, 'C'}, {1, 'A'}}};
  for (const auto& [first, letter] : kSeries) {
    if (series() >= first) return print("%c%dM%d", letter, series() - first + 1, model & 0xF);
  }
  return print("model 0x%02x", model);
}

std::string DeviceInfo::firmware_text() const {
  return print("%d.%02d", firmware >> 8, firmware & 0xFF);
}

std::string DeviceInfo::serial_text() const {
  std::string text;
  for (const std::uint8_t byte : serial) text += print("%02X", byte);
  return text;
}

std::array<std::uint8_t, Health::kSize> Health::encode() const {
  return {status, low(code), high(code)};
}

std::optional<Health> Health::decode(std::span<const std::uint8_t> bytes) {
  if (bytes.size() < kSize) return std::nullopt;
  return Health{.status = bytes[0], .code = read_u16(bytes.subspan(1))};
}

std::string Health::text() const {
  if (status == static_cast<std::uint8_t>(HealthStatus::kGood) && code == 0) return "good";
  const char* name = failed()                                                      ? "error"
                     : status == static_cast<std::uint8_t>(HealthStatus::kWarning) ? "warning"
                                                                                   : "good";
  return print("%s (code 0x%04x)", name, code);
}

std::array<std::uint8_t, SampleRate::kSize> SampleRate::encode() const {
  return {low(standard_us), high(standard_us), low(express_us), high(express_us)};
}

std::optional<SampleRate> SampleRate::decode(std::span<const std::uint8_t> bytes) {
  if (bytes.size() < kSize) return std::nullopt;
  return SampleRate{.standard_us = read_u16(bytes), .express_us = read_u16(bytes.subspan(2))};
}

std::optional<ConfAnswer> ConfAnswer::decode(std::span<const std::uint8_t> bytes) {
  if (bytes.size() < 4) return std::nullopt;
  return ConfAnswer{.type = read_u32(bytes), .value = bytes.subspan(4)};
}

std::optional<std::uint32_t> ConfAnswer::number(std::size_t size) const {
  if (value.size() < size) return std::nullopt;
  std::uint32_t number = 0;
  for (std::size_t i = 0; i < size; ++i) number |= static_cast<std::uint32_t>(value[i]) << 8 * i;
  return number;
}

std::string_view ConfAnswer::text() const {
  const auto end = std::find(value.begin(), value.end(), std::uint8_t{0});
  return {reinterpret_cast<const char*>(value.data()),
          static_cast<std::size_t>(end - value.begin())};
}

std::optional<ConfQuery> ConfQuery::decode(std::span<const std::uint8_t> payload) {
  if (payload.size() < 4) return std::nullopt;
  ConfQuery query{.type = read_u32(payload), .mode = std::nullopt};
  if (payload.size() >= 6) query.mode = read_u16(payload.subspan(4));
  return query;
}

}  // namespace cornerd::rplidar
