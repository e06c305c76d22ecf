// SPDX-License-Identifier: MIT
// Requests to an RPLidar, response descriptors and the boot banner. The driver and the emulator
// share it.
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
  kSetMotorSpeed = 0xA8,  ///< revolutions per minute; C and S series
  kSetMotorPwm = 0xF0,
  kGetAccessoryBoard = 0xFF,
};

/// Requests from 0x80 up carry a payload, its length and a checksum.
constexpr bool has_payload(Command command) {
  return (static_cast<std::uint8_t>(command) & 0x80) != 0;
}

/// A request as on the wire.
class Request {
 public:
  /// `payload`: at most 255 bytes, ignored where the command carries none.
  explicit Request(Command command, std::span<const std::uint8_t> payload = {});

  Command command() const { return static_cast<Command>(bytes_[1]); }
  std::span<const std::uint8_t> bytes() const { return {bytes_.data(), size_}; }
  /// Empty for commands without one.
  std::span<const std::uint8_t> payload() const;

  /// Mode 0 is "legacy express", whatever the mode table says.
  static Request express_scan(std::uint8_t mode);
  /// GET_LIDAR_CONF, of a common value or of one mode.
  static Request get_conf(std::uint32_t type, std::optional<std::uint16_t> mode = std::nullopt);
  /// kSetMotorPwm or kSetMotorSpeed.
  static Request set_motor(Command command, std::uint16_t value);

 private:
  static constexpr std::size_t kMaxSize = 3 + 255 + 1;

  std::array<std::uint8_t, kMaxSize> bytes_{};
  std::size_t size_ = 0;
};

/// Finds requests in what a device receives. Skips other bytes, and requests with a wrong checksum,
/// as the A1 does.
class RequestParser {
 public:
  /// The request that this byte completes.
  std::optional<Request> add(std::uint8_t byte);
  /// Drops an incomplete request: its bytes must come within 5 s.
  void reset() { size_ = 0; }
  bool in_request() const { return size_ > 0; }

 private:
  std::array<std::uint8_t, 3 + 255 + 1> bytes_{};
  std::size_t size_ = 0;
};

inline constexpr std::size_t kDescriptorSize = 7;

/// The types of its answers.
enum class AnswerType : std::uint8_t {
  kInfo = 0x04,
  kHealth = 0x06,
  kSampleRate = 0x15,
  kGetConf = 0x20,
  kSetConf = 0x21,
  kStandardScan = 0x81,
  kExpressScan = 0x82,
  kHqScan = 0x83,
  kUltraScan = 0x84,
  kDenseScan = 0x85,
  kUltraDenseScan = 0x86,
  kAccessoryBoard = 0xFF,
};

/// The header of an answer: `A5 5A`, size and mode, type.
struct Descriptor {
  std::uint32_t size = 0;  ///< bytes of one data packet, below 2^30
  bool stream = false;     ///< many packets until the next request; else one
  std::uint8_t type = 0;

  std::array<std::uint8_t, kDescriptorSize> encode() const;
  bool is(AnswerType answer) const { return type == static_cast<std::uint8_t>(answer); }
};

/// Finds descriptors among other bytes: stale measurements, an echo, another A5.
class DescriptorSearch {
 public:
  /// The descriptor that this byte completes.
  std::optional<Descriptor> add(std::uint8_t byte);
  void reset() { size_ = 0; }

 private:
  std::array<std::uint8_t, kDescriptorSize> bytes_{};
  std::size_t size_ = 0;
};

/// Finds the text that an A1 prints after power-on or reset: "RP LIDAR System." and two lines that
/// depend on the firmware.
class BannerSearch {
 public:
  /// True if the banner's first words end in `bytes`; they may begin in an earlier call.
  bool add(std::span<const std::uint8_t> bytes);

 private:
  std::size_t matched_ = 0;
};

}  // namespace cornerd::rplidar
