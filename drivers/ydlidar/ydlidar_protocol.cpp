// SPDX-License-Identifier: MIT
#include "drivers/ydlidar/ydlidar_protocol.hpp"

#include <chrono>
#include <cstddef>
#include <string>

#include "drivers/rplidar/protocol/answers.hpp"
#include "drivers/rplidar/protocol/framing.hpp"

namespace cornerd::ydlidar {
namespace {

using std::chrono::milliseconds;
using RequestBytes = std::array<std::uint8_t, 2>;

constexpr RequestBytes kStart = {0xA5, 0x60};
constexpr RequestBytes kStop = {0xA5, 0x65};
constexpr RequestBytes kGetInfo = {0xA5, 0x90};
// The manuals say 91, the vendor's SDK sends 92.
constexpr std::array<RequestBytes, 2> kGetHealth = {{{0xA5, 0x91}, {0xA5, 0x92}}};

constexpr milliseconds kAnswerTimeout{300};
constexpr milliseconds kDrainLimit{300};  // an X2 never stops sending
constexpr milliseconds kIdle{20};         // pauses within a stream are shorter
constexpr milliseconds kSlice{50};
constexpr int kTries = 2;

constexpr std::uint8_t kModelX4 = 6;

/// Requests to a device, one answer each.
class Conversation {
 public:
  Conversation(drivers::ByteStream& port, drivers::Clock& clock, const std::stop_token& stop)
      : port_(port), clock_(clock), stop_(stop) {}

  bool send(const RequestBytes& request) { return port_.write(request); }
  std::uint64_t received() const { return received_; }
  std::uint64_t used() const { return used_; }

  void drain() {
    const core::TimeNs until_ns = deadline(kDrainLimit);
    while (goes_on(until_ns) && !read(kIdle).empty()) {
    }
  }

  /// Of `size` bytes; empty without an answer.
  std::span<const std::uint8_t> query(const RequestBytes& request, rplidar::AnswerType type,
                                      std::size_t size) {
    if (!send(request)) return {};
    const core::TimeNs until_ns = deadline(kAnswerTimeout);
    rplidar::DescriptorSearch search;
    bool in_answer = false;
    std::size_t count = 0;
    while (goes_on(until_ns)) {
      for (const std::uint8_t byte : read(kSlice)) {
        if (!in_answer) {
          const auto found = search.add(byte);
          in_answer = found && found->is(type) && found->size == size;
          continue;
        }
        answer_[count++] = byte;
        if (count < size) continue;
        used_ += rplidar::kDescriptorSize + size;
        return std::span(answer_).first(size);
      }
    }
    return {};
  }

 private:
  core::TimeNs deadline(milliseconds limit) {
    return clock_.monotonic_ns() + std::chrono::nanoseconds(limit).count();
  }
  bool goes_on(core::TimeNs until_ns) {
    return !lost_ && !stop_.stop_requested() && clock_.monotonic_ns() < until_ns;
  }
  std::span<const std::uint8_t> read(milliseconds timeout) {
    const auto result = port_.read(buffer_, timeout);
    lost_ = result.status == drivers::ByteStream::ReadStatus::kLost;
    received_ += result.count;
    return std::span(buffer_).first(result.count);
  }

  drivers::ByteStream& port_;
  drivers::Clock& clock_;
  const std::stop_token& stop_;
  bool lost_ = false;
  std::uint64_t received_ = 0;
  std::uint64_t used_ = 0;
  std::array<std::uint8_t, 256> buffer_{};
  std::array<std::uint8_t, 32> answer_{};
};

}  // namespace

std::optional<drivers::StreamProtocol::Device> YdlidarProtocol::start(drivers::ByteStream& port,
                                                                      drivers::Clock& clock,
                                                                      const std::stop_token& stop) {
  // Without DTR, as on a UART of the board, the motor has its own supply.
  if (motor_by_dtr_) static_cast<void>(port.set_dtr(true));
  Conversation device(port, clock, stop);
  device.send(kStop);
  device.drain();
  for (int attempt = 0; attempt < kTries; ++attempt) {
    const auto answer =
        device.query(kGetInfo, rplidar::AnswerType::kInfo, rplidar::DeviceInfo::kSize);
    const auto info = rplidar::DeviceInfo::decode(answer);
    if (!info) continue;
    Device found{.model = info->model == kModelX4 ? "X4" : "YDLIDAR " + std::to_string(info->model),
                 .firmware = info->firmware_text(),
                 .serial = info->serial_text(),
                 .health = {},
                 .sample_period_s = kPeriodX4S};
    for (const RequestBytes& request : kGetHealth) {
      const auto health = rplidar::Health::decode(
          device.query(request, rplidar::AnswerType::kHealth, rplidar::Health::kSize));
      if (!health) continue;
      found.health = health->text();
      found.failed = health->failed();
      break;
    }
    found.received_bytes = device.received();
    found.used_bytes = device.used();
    device.send(kStart);
    return found;
  }
  if (device.received() == 0) return std::nullopt;
  return Device{.model = "X2",
                .firmware = {},
                .serial = {},
                .health = {},
                .sample_period_s = kPeriodX2S,
                .received_bytes = device.received()};
}

void YdlidarProtocol::stop(drivers::ByteStream& port) {
  port.write(kStop);
  if (motor_by_dtr_) static_cast<void>(port.set_dtr(false));
}

}  // namespace cornerd::ydlidar
