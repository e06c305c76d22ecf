// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
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

  /// Consumer: calls `use` with the oldest filled slot, then returns the slot. False if there is
  /// none.
  bool take(const auto& use) {
    std::uint32_t index = 0;
    if (!filled_.pop(index)) return false;
    use(static_cast<const T&>(slots_[index]));
    empty_.push(index);
    return true;
  }

 private:
  std::vector<T> slots_;
  core::RingBuffer<std::uint32_t> filled_;
  core::RingBuffer<std::uint32_t> empty_;
};

}  // namespace cornerd::daemon
