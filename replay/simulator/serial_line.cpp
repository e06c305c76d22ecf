// SPDX-License-Identifier: MIT
#include "replay/simulator/serial_line.hpp"

namespace cornerd::replay {

ByteFaults::ByteFaults(double probability, std::uint64_t seed)
    : probability_(probability), random_(seed) {}

std::span<const std::uint8_t> ByteFaults::pass(std::span<const std::uint8_t> sent) {
  if (probability_ <= 0) return sent;
  arrived_.clear();
  for (const std::uint8_t byte : sent) {
    if (!random_.chance(probability_)) {
      arrived_.push_back(byte);
      continue;
    }
    ++faults_;
    const std::uint64_t kind = random_.bits() % 3;
    if (kind == 0) continue;
    const auto damage = kind == 1 ? std::uint64_t{1} << random_.bits() % 8  // one bit
                                  : 1 + random_.bits() % 255;               // another byte
    arrived_.push_back(static_cast<std::uint8_t>(byte ^ damage));
  }
  return arrived_;
}

}  // namespace cornerd::replay
