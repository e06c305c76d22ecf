// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

namespace cornerd::rplidar {

inline constexpr std::size_t kDescriptorSize = 7;

/// The types of an A1's answers.
enum class AnswerType : std::uint8_t {
  kInfo = 0x04,
  kHealth = 0x06,
  kSampleRate = 0x15,
  kGetConf = 0x20,
  kSetConf = 0x21,
  kStandardScan = 0x81,
  kExpressScan = 0x82,
  kUltraScan = 0x84,
  kAccessoryBoard = 0xFF,
};

/// What an answer begins with: `A5 5A`, its size and mode, its type.
struct Descriptor {
  std::uint32_t size = 0;  ///< bytes of one data packet, below 2^30
  bool stream = false;     ///< packet after packet until the next request; else one
  std::uint8_t type = 0;

  std::array<std::uint8_t, kDescriptorSize> encode() const;
  bool is(AnswerType answer) const { return type == static_cast<std::uint8_t>(answer); }
};

/// Finds descriptors wherever they stand: after stale measurements, an echo, or another A5.
class DescriptorSearch {
 public:
  /// The descriptor that this byte completes.
  std::optional<Descriptor> add(std::uint8_t byte);
  void reset() { size_ = 0; }

 private:
  std::array<std::uint8_t, kDescriptorSize> bytes_{};
  std::size_t size_ = 0;
};

}  // namespace cornerd::rplidar
