// SPDX-License-Identifier: MIT
// What a host says to an A1, in both directions: built by the driver, understood by the emulator.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

namespace cornerd::rplidar {

inline constexpr std::uint8_t kSync = 0xA5;
inline constexpr std::uint8_t kDescriptorSync = 0x5A;

enum class Command : std::uint8_t {
  kScan = 0x20,
  kForceScan = 0x21,
  kStop = 0x25,
  kReset = 0x40,
  kGetInfo = 0x50,
  kGetHealth = 0x52,
  kGetSampleRate = 0x59,
  kExpressScan = 0x82,
  kGetConf = 0x84,
  kSetConf = 0x85,
  kSetMotorPwm = 0xF0,
  kGetAccessoryBoard = 0xFF,
};

/// Requests from 0x80 up carry a payload, its length and a checksum.
constexpr bool has_payload(Command command) {
  return (static_cast<std::uint8_t>(command) & 0x80) != 0;
}

/// A request as it goes over the wire.
class Request {
 public:
  /// `payload`: at most 255 bytes, ignored where the command carries none.
  explicit Request(Command command, std::span<const std::uint8_t> payload = {});

  Command command() const { return static_cast<Command>(bytes_[1]); }
  std::span<const std::uint8_t> bytes() const { return {bytes_.data(), size_}; }
  /// Empty for commands without one.
  std::span<const std::uint8_t> payload() const;

  /// EXPRESS_SCAN. Mode 0 is "legacy express", whatever the mode table calls 0.
  static Request express_scan(std::uint8_t mode);
  /// GET_LIDAR_CONF of a value that all modes share, or of one mode.
  static Request get_conf(std::uint32_t type, std::optional<std::uint16_t> mode = std::nullopt);

 private:
  static constexpr std::size_t kMaxSize = 3 + 255 + 1;

  std::array<std::uint8_t, kMaxSize> bytes_{};
  std::size_t size_ = 0;
};

/// Finds requests in what a device receives. Bytes that are none, and requests with a wrong
/// checksum, are passed over in silence, as the A1 does.
class RequestParser {
 public:
  /// A request, where this byte completes one.
  std::optional<Request> add(std::uint8_t byte);
  /// Forgets a request that was begun: its bytes must come within 5 s.
  void reset() { size_ = 0; }
  bool in_request() const { return size_ > 0; }

 private:
  std::array<std::uint8_t, 3 + 255 + 1> bytes_{};
  std::size_t size_ = 0;
};

}  // namespace cornerd::rplidar
