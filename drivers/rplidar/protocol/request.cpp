// SPDX-License-Identifier: MIT
#include "drivers/rplidar/protocol/request.hpp"

#include <algorithm>
#include <functional>
#include <numeric>

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

}  // namespace cornerd::rplidar
