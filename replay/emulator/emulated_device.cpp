// SPDX-License-Identifier: MIT
#include "replay/emulator/emulated_device.hpp"

#include <algorithm>
#include <memory>
#include <utility>
#include <vector>

namespace cornerd::replay {
namespace {

/// Takes up to `room` from `wish`.
std::size_t grant(std::size_t& wish, std::size_t room) {
  const std::size_t granted = std::min(wish, room);
  wish -= granted;
  return granted;
}

}  // namespace

FaultStream::ReadResult FaultStream::read(std::span<std::uint8_t> buffer,
                                          std::chrono::milliseconds timeout) {
  // Repeated and inserted bytes need room.
  std::vector<std::uint8_t> sent(buffer.size() / 2);
  const ReadResult result = stream_->read(sent, timeout);
  if (result.status != ReadStatus::kData) return result;
  sent.resize(result.count);
  sent.erase(sent.begin(),
             sent.begin() + static_cast<std::ptrdiff_t>(grant(faults_.to_lose, sent.size())));

  std::vector<std::uint8_t> arrived(grant(faults_.to_insert, buffer.size() / 4));
  for (std::uint8_t& byte : arrived) byte = static_cast<std::uint8_t>(faults_.random.bits());
  ByteFaults damage(faults_.damaged_share, faults_.random.bits());
  const auto damaged = damage.pass(sent);
  arrived.insert(arrived.end(), damaged.begin(), damaged.end());
  const std::size_t again = grant(faults_.to_repeat, std::min(damaged.size(), buffer.size() / 4));
  arrived.insert(arrived.end(), damaged.end() - static_cast<std::ptrdiff_t>(again), damaged.end());

  std::copy(arrived.begin(), arrived.end(), buffer.begin());
  faults_.delivered += arrived.size();
  return {arrived.empty() ? ReadStatus::kTimeout : ReadStatus::kData, arrived.size()};
}

namespace {

/// Interval of a USB adapter's transfers.
constexpr core::TimeNs kPortionNs = 4'000'000;

}  // namespace

class EmulatedDevice::Port : public drivers::ByteStream {
 public:
  explicit Port(EmulatedDevice& device) : device_(device), plugs_(device.plugs_) {}

  ReadResult read(std::span<std::uint8_t> buffer, std::chrono::milliseconds timeout) override {
    VirtualClock& clock = device_.clock_;
    const core::TimeNs until_ns = clock.monotonic_ns() + std::chrono::nanoseconds(timeout).count();
    while (!is_lost()) {
      device_.emulator_.take(clock.monotonic_ns(), device_.received_);
      if (!device_.received_.empty()) return hand_over(buffer);
      if (clock.monotonic_ns() >= until_ns) return {};
      const core::TimeNs next_ns = device_.emulator_.next_ns().value_or(until_ns);
      clock.advance_to(std::clamp(next_ns, clock.monotonic_ns() + kPortionNs,
                                  std::max(until_ns, clock.monotonic_ns() + kPortionNs)));
    }
    return {ReadStatus::kLost, 0};
  }

  bool write(std::span<const std::uint8_t> bytes) override {
    if (is_lost()) return false;
    device_.emulator_.receive(bytes, device_.clock_.monotonic_ns());
    return true;
  }

  void discard_input() override { device_.received_.clear(); }
  bool set_dtr(bool /*asserted*/) override { return true; }

 private:
  bool is_lost() const { return !device_.plugged_ || device_.plugs_ != plugs_; }

  ReadResult hand_over(std::span<std::uint8_t> buffer) {
    std::vector<std::uint8_t>& received = device_.received_;
    const std::size_t count = std::min(buffer.size(), received.size());
    std::copy_n(received.begin(), count, buffer.begin());
    received.erase(received.begin(), received.begin() + static_cast<std::ptrdiff_t>(count));
    return {ReadStatus::kData, count};
  }

  EmulatedDevice& device_;
  const std::uint64_t plugs_;
};

EmulatedDevice::EmulatedDevice(Emulator emulator, VirtualClock& clock, std::uint64_t seed)
    : emulator_(std::move(emulator)), clock_(clock), faults_(seed) {}

drivers::OpenResult EmulatedDevice::open() {
  if (!plugged_) return {nullptr, drivers::OpenError::kAbsent, "/dev/emulated: no such port"};
  received_.clear();
  return {std::make_unique<FaultStream>(std::make_unique<Port>(*this), faults_),
          drivers::OpenError::kNone,
          {}};
}

void EmulatedDevice::plug(bool plugged) {
  if (plugged_ && !plugged) ++plugs_;
  plugged_ = plugged;
}

}  // namespace cornerd::replay
