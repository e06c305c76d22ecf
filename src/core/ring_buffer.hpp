// SPDX-License-Identifier: MIT
// The queue between the reader thread and the localizer thread.
#pragma once

#include <atomic>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <type_traits>

namespace cornerd::core {

/// Wait-free queue of fixed size for one producer and one consumer thread. No allocation after
/// construction. A full queue refuses and counts the newest element, so queued data stays
/// contiguous.
///
/// Each index has one writer, which publishes it with release after the slot; the other side reads
/// it with acquire. Each side caches the other's index and reads the shared one only if the cached
/// one says full or empty.
template <typename T>
class RingBuffer {
  static_assert(std::is_trivially_copyable_v<T>);

 public:
  /// Room for at least `capacity` elements (rounded up to a power of two).
  explicit RingBuffer(std::size_t capacity)
      : mask_(std::bit_ceil(capacity < 2 ? std::size_t{2} : capacity) - 1),
        slots_(std::make_unique<T[]>(mask_ + 1)) {}

  /// Producer. False if the buffer is full: the element is lost and counted.
  bool push(const T& element) {
    const std::size_t head = head_.load(std::memory_order_relaxed);
    if (head - known_tail_ > mask_) {
      known_tail_ = tail_.load(std::memory_order_acquire);
      if (head - known_tail_ > mask_) {
        overflows_.fetch_add(1, std::memory_order_relaxed);
        return false;
      }
    }
    slots_[head & mask_] = element;
    head_.store(head + 1, std::memory_order_release);
    return true;
  }

  /// Consumer. False if the buffer is empty.
  bool pop(T& element) {
    const std::size_t tail = tail_.load(std::memory_order_relaxed);
    if (tail == known_head_) {
      known_head_ = head_.load(std::memory_order_acquire);
      if (tail == known_head_) return false;
    }
    element = slots_[tail & mask_];
    tail_.store(tail + 1, std::memory_order_release);
    return true;
  }

  std::size_t capacity() const { return mask_ + 1; }
  /// Elements refused so far. Any thread.
  std::uint64_t overflows() const { return overflows_.load(std::memory_order_relaxed); }

 private:
  static constexpr std::size_t kCacheLine = 64;

  const std::size_t mask_;
  const std::unique_ptr<T[]> slots_;
  alignas(kCacheLine) std::atomic<std::size_t> head_{0};
  std::size_t known_tail_ = 0;
  std::atomic<std::uint32_t> overflows_{0};
  alignas(kCacheLine) std::atomic<std::size_t> tail_{0};
  std::size_t known_head_ = 0;
};

}  // namespace cornerd::core
