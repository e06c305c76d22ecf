// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "core/ring_buffer.hpp"

namespace cornerd::daemon {

/// Passes large values between two threads in order, in preallocated slots: no lock, no allocation.
/// Two ring buffers carry the indices of filled and of empty slots.
template <typename T>
class SlotExchange {
 public:
  explicit SlotExchange(std::size_t slots) : slots_(slots), filled_(slots), empty_(slots) {
    for (std::uint32_t i = 0; i < slots; ++i) empty_.push(i);
  }

  /// Producer: calls `fill` with a slot and passes it on. False if no slot is empty.
  bool put(const auto& fill) {
    std::uint32_t index = 0;
    if (!empty_.pop(index)) return false;
    fill(slots_[index]);
    filled_.push(index);
    return true;
  }

  /// Consumer: the oldest filled slot; null if there is none. Valid until take().
  const T* front() {
    std::uint32_t index = 0;
    if (!front_ && filled_.pop(index)) front_ = index;
    return front_ ? &slots_[*front_] : nullptr;
  }

  /// Consumer: calls `use` with the oldest filled slot, then returns the slot. False if there is
  /// none.
  bool take(const auto& use) {
    const T* const oldest = front();
    if (oldest == nullptr) return false;
    use(*oldest);
    empty_.push(*std::exchange(front_, std::nullopt));
    return true;
  }

 private:
  std::vector<T> slots_;
  core::RingBuffer<std::uint32_t> filled_;
  core::RingBuffer<std::uint32_t> empty_;
  std::optional<std::uint32_t> front_;  ///< owned by the consumer
};

}  // namespace cornerd::daemon
