// SPDX-License-Identifier: MIT
#include "replay/emulator/pty_emulator.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <utility>

namespace cornerd::replay {
namespace {

using std::chrono::duration_cast;
using std::chrono::nanoseconds;

constexpr int kMaxWaitMs = 10;
constexpr core::TimeNs kOnTimePeriodNs = 10'000'000;

/// A byte takes 87 us; wakes up at most every 1 ms, as USB adapters do.
int wait_ms(std::optional<core::TimeNs> next_ns, core::TimeNs now_ns) {
  if (!next_ns) return kMaxWaitMs;
  return static_cast<int>(std::clamp<core::TimeNs>((*next_ns - now_ns) / 1'000'000, 1, kMaxWaitMs));
}

}  // namespace

PtyEmulator::PtyEmulator(std::unique_ptr<DeviceEmulator> emulator,
                         const std::filesystem::path& link, std::uint32_t baud)
    : emulator_(std::move(emulator)), terminal_(link, baud) {}

void PtyEmulator::run(const std::stop_token& stop) {
  const auto start = std::chrono::steady_clock::now();
  const core::TimeNs start_unix_ns =
      duration_cast<nanoseconds>(std::chrono::system_clock::now().time_since_epoch()).count();
  const auto elapsed_ns = [&] {
    return core::TimeNs{
        duration_cast<nanoseconds>(std::chrono::steady_clock::now() - start).count()};
  };
  core::TimeNs reported_ns = -kOnTimePeriodNs;
  while (!stop.stop_requested()) {
    core::TimeNs now_ns = elapsed_ns();
    const bool has_client = terminal_.wait(wait_ms(emulator_->next_ns(), now_ns));
    now_ns = elapsed_ns();
    exchange(now_ns, has_client);
    if (on_time_ && now_ns - reported_ns >= kOnTimePeriodNs) {
      on_time_(now_ns, start_unix_ns + now_ns);
      reported_ns = now_ns;
    }
  }
}

void PtyEmulator::exchange(core::TimeNs now_ns, bool has_client) {
  const std::uint32_t baud = expected_baud_.load();
  const bool understood = baud == 0 || terminal_.has_speed(baud);
  std::array<std::uint8_t, 512> in;
  for (std::size_t count = terminal_.read(in); count > 0; count = terminal_.read(in)) {
    if (understood) emulator_->receive(std::span(in).first(count), now_ns);
  }
  out_.clear();
  emulator_->take(now_ns, out_);
  if (!understood) {
    for (std::uint8_t& byte : out_) byte = static_cast<std::uint8_t>(byte * 37 + 11);
  }
  const std::size_t written = terminal_.write(out_);
  if (has_client) lost_bytes_ += out_.size() - written;
}

}  // namespace cornerd::replay
