// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "replay/simulator/random.hpp"

namespace cornerd::replay {

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
