// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/ring_buffer.hpp"

namespace cornerd::daemon {

/// Hands large values from one thread to another in order, in slots that were made beforehand: no
/// lock, no allocation, no copy beyond the producer's own. The indices of the slots travel round in
/// two ring buffers: filled ones forth, empty ones back.
template <typename T>
class SlotExchange {
 public:
  explicit SlotExchange(std::size_t slots) : slots_(slots), filled_(slots), empty_(slots) {
    for (std::uint32_t i = 0; i < slots; ++i) empty_.push(i);
  }

  /// Producer: calls `fill` with a slot and hands it over. False where the consumer has yet to
  /// return one.
  bool put(const auto& fill) {
    std::uint32_t index = 0;
    if (!empty_.pop(index)) return false;
    fill(slots_[index]);
    filled_.push(index);
    return true;
  }

  /// Consumer: calls `use` with the oldest filled slot, then returns it. False where there is none.
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
