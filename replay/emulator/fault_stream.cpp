// SPDX-License-Identifier: MIT
#include "replay/emulator/fault_stream.hpp"

#include <algorithm>
#include <vector>

namespace cornerd::replay {
namespace {

/// Takes from `wish` what there is room for.
std::size_t grant(std::size_t& wish, std::size_t room) {
  const std::size_t granted = std::min(wish, room);
  wish -= granted;
  return granted;
}

}  // namespace

FaultStream::ReadResult FaultStream::read(std::span<std::uint8_t> buffer,
                                          std::chrono::milliseconds timeout) {
  // What is repeated or invented needs room.
  std::vector<std::uint8_t> sent(buffer.size() / 2);
  const ReadResult result = stream_->read(sent, timeout);
  if (result.status != ReadStatus::kData) return result;
  sent.resize(result.count);
  sent.erase(sent.begin(),
             sent.begin() + static_cast<std::ptrdiff_t>(grant(faults_.to_lose, sent.size())));

  std::vector<std::uint8_t> arrived(grant(faults_.to_invent, buffer.size() / 4));
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

}  // namespace cornerd::replay
