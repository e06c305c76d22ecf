// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/types.hpp"
#include "replay/simulator/random.hpp"

namespace cornerd::replay {

/// Transmission times on an 8N1 serial line: ten bit times per byte.
class SerialLine {
 public:
  explicit SerialLine(std::uint32_t baud = 115200) : baud_(baud) {}

  /// Queues `count` bytes at `t_ns`; returns the arrival of the last one.
  core::TimeNs send(core::TimeNs t_ns, std::size_t count) {
    free_ns_ = std::max(free_ns_, t_ns) + duration_ns(count);
    return free_ns_;
  }
  core::TimeNs free_ns() const { return free_ns_; }
  /// Drops queued bytes: the line is free from `t_ns` on.
  void free_from(core::TimeNs t_ns) { free_ns_ = t_ns; }
  core::TimeNs duration_ns(std::size_t count) const {
    return static_cast<core::TimeNs>(count) * 10 * core::kNsPerSecond / baud_;
  }

 private:
  std::uint32_t baud_;
  core::TimeNs free_ns_ = 0;
};

/// Damages each byte with the given probability: lost, one bit flipped, or replaced, equally
/// likely.
class ByteFaults {
 public:
  ByteFaults(double probability, std::uint64_t seed);

  /// The bytes that arrive; valid until the next call.
  std::span<const std::uint8_t> pass(std::span<const std::uint8_t> sent);

  std::uint64_t faults() const { return faults_; }

 private:
  double probability_;
  Random random_;
  std::vector<std::uint8_t> arrived_;
  std::uint64_t faults_ = 0;
};

}  // namespace cornerd::replay
