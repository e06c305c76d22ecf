// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <thread>

namespace cornerd::test {

/// Enough for a loaded machine and a sanitizer; only a failing test waits so long.
inline constexpr std::chrono::seconds kPatience{60};

/// Waits for a condition. False after kPatience: a test that would hang fails.
bool wait_until(const auto& condition) {
  const auto deadline = std::chrono::steady_clock::now() + kPatience;
  while (!condition()) {
    if (std::chrono::steady_clock::now() > deadline) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  return true;
}

}  // namespace cornerd::test
