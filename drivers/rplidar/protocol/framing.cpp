// SPDX-License-Identifier: MIT
#include "drivers/rplidar/protocol/framing.hpp"

#include <algorithm>
#include <functional>
#include <numeric>
#include <string_view>

namespace cornerd::rplidar {
namespace {

constexpr std::size_t kHeaderSize = 2;
constexpr std::size_t kPayloadBegin = 3;
constexpr std::size_t kMaxPayload = 255;

std::uint8_t checksum(std::span<const std::uint8_t> bytes) {
  return static_cast<std::uint8_t>(
      std::accumulate(bytes.begin(), bytes.end(), 0, std::bit_xor<>()));
}

}  // namespace

Request::Request(Command command, std::span<const std::uint8_t> payload) : size_(kHeaderSize) {
  bytes_[0] = kSync;
  bytes_[1] = static_cast<std::uint8_t>(command);
  if (!has_payload(command)) return;
  payload = payload.first(std::min(payload.size(), kMaxPayload));
  bytes_[2] = static_cast<std::uint8_t>(payload.size());
  std::copy(payload.begin(), payload.end(), bytes_.begin() + kPayloadBegin);
  size_ = kPayloadBegin + payload.size();
  bytes_[size_] = checksum(bytes());
  ++size_;
}

std::span<const std::uint8_t> Request::payload() const {
  if (!has_payload(command())) return {};
  return bytes().subspan(kPayloadBegin, bytes_[2]);
}

Request Request::express_scan(std::uint8_t mode) {
  return Request(Command::kExpressScan, std::array<std::uint8_t, 5>{mode, 0, 0, 0, 0});
}

Request Request::get_conf(std::uint32_t type, std::optional<std::uint16_t> mode) {
  std::array<std::uint8_t, 6> payload{};
  for (std::size_t i = 0; i < 4; ++i) payload[i] = static_cast<std::uint8_t>(type >> 8 * i);
  if (!mode) return Request(Command::kGetConf, std::span(payload).first(4));
  payload[4] = static_cast<std::uint8_t>(*mode);
  payload[5] = static_cast<std::uint8_t>(*mode >> 8);
  return Request(Command::kGetConf, payload);
}

Request Request::set_motor(Command command, std::uint16_t value) {
  return Request(
      command, std::array{static_cast<std::uint8_t>(value), static_cast<std::uint8_t>(value >> 8)});
}

std::optional<Request> RequestParser::add(std::uint8_t byte) {
  if (size_ == 0 && byte != kSync) return std::nullopt;
  if (size_ == 1 && byte == kSync) return std::nullopt;  // the request begins here instead
  bytes_[size_++] = byte;
  if (size_ < kHeaderSize) return std::nullopt;

  const auto command = static_cast<Command>(bytes_[1]);
  if (!has_payload(command)) {
    size_ = 0;
    return Request(command);
  }
  if (size_ < kPayloadBegin || size_ < kPayloadBegin + bytes_[2] + std::size_t{1}) {
    return std::nullopt;
  }
  const auto frame = std::span<const std::uint8_t>(bytes_).first(size_);
  size_ = 0;
  if (checksum(frame) != 0) return std::nullopt;
  return Request(command, frame.subspan(kPayloadBegin, frame.size() - kPayloadBegin - 1));
}

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

namespace {

constexpr std::string_view kFirstWords = "RP LIDAR";

}  // namespace

bool BannerSearch::add(std::span<const std::uint8_t> bytes) {
  bool found = false;
  for (const std::uint8_t byte : bytes) {
    const char character = static_cast<char>(byte);
    // No proper prefix recurs inside the words, so a mismatch restarts the match.
    if (character != kFirstWords[matched_]) matched_ = 0;
    if (character == kFirstWords[matched_]) ++matched_;
    if (matched_ < kFirstWords.size()) continue;
    found = true;
    matched_ = 0;
  }
  return found;
}

}  // namespace cornerd::rplidar
