// SPDX-License-Identifier: MIT
#include "drivers/rplidar/protocol/descriptor.hpp"

#include "drivers/rplidar/protocol/request.hpp"

namespace cornerd::rplidar {
namespace {

constexpr std::uint32_t kSizeMask = 0x3FFFFFFF;
constexpr std::uint32_t kStreamMode = 1U << 30;

}  // namespace

std::array<std::uint8_t, kDescriptorSize> Descriptor::encode() const {
  const std::uint32_t word = (size & kSizeMask) | (stream ? kStreamMode : 0);
  return {kSync,
          kDescriptorSync,
          static_cast<std::uint8_t>(word),
          static_cast<std::uint8_t>(word >> 8),
          static_cast<std::uint8_t>(word >> 16),
          static_cast<std::uint8_t>(word >> 24),
          type};
}

std::optional<Descriptor> DescriptorSearch::add(std::uint8_t byte) {
  if (size_ == 0 && byte != kSync) return std::nullopt;
  if (size_ == 1 && byte != kDescriptorSync) {
    size_ = byte == kSync ? 1 : 0;
    return std::nullopt;
  }
  bytes_[size_++] = byte;
  if (size_ < kDescriptorSize) return std::nullopt;
  size_ = 0;
  const std::uint32_t word = bytes_[2] | static_cast<std::uint32_t>(bytes_[3]) << 8 |
                             static_cast<std::uint32_t>(bytes_[4]) << 16 |
                             static_cast<std::uint32_t>(bytes_[5]) << 24;
  return Descriptor{
      .size = word & kSizeMask, .stream = (word & ~kSizeMask) == kStreamMode, .type = bytes_[6]};
}

}  // namespace cornerd::rplidar
