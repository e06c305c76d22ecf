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

/// When bytes have crossed a serial line of 8N1: ten bit times each, one after the other.
class SerialLine {
 public:
  explicit SerialLine(std::uint32_t baud = 115200) : baud_(baud) {}

  /// When the last of `count` bytes arrives that are handed to the line at `t_ns`.
  core::TimeNs send(core::TimeNs t_ns, std::size_t count) {
    free_ns_ = std::max(free_ns_, t_ns) + duration_ns(count);
    return free_ns_;
  }
  core::TimeNs free_ns() const { return free_ns_; }
  /// Takes back what was handed over and has not been sent by then.
  void free_from(core::TimeNs t_ns) { free_ns_ = t_ns; }
  core::TimeNs duration_ns(std::size_t count) const {
    return static_cast<core::TimeNs>(count) * 10 * core::kNsPerSecond / baud_;
  }

 private:
  std::uint32_t baud_;
  core::TimeNs free_ns_ = 0;
};

/// A bad line: each byte is, with the given probability, lost, or has a bit flipped, or is replaced
/// by another one, each as likely.
class ByteFaults {
 public:
  ByteFaults(double probability, std::uint64_t seed);

  /// What arrives of `sent`. Valid until the next call.
  std::span<const std::uint8_t> pass(std::span<const std::uint8_t> sent);

  std::uint64_t faults() const { return faults_; }

 private:
  double probability_;
  Random random_;
  std::vector<std::uint8_t> arrived_;
  std::uint64_t faults_ = 0;
};

}  // namespace cornerd::replay
