// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace cornerd::bench {

/// Counts the instructions of this thread in user space by the processor's counter
/// (perf_event_open). Unavailable where the processor or the kernel's permissions lack it.
class InstructionCounter {
 public:
  InstructionCounter();
  ~InstructionCounter();
  InstructionCounter(const InstructionCounter&) = delete;
  InstructionCounter& operator=(const InstructionCounter&) = delete;

  bool is_available() const { return descriptor_ >= 0; }

  template <typename Task>
  std::optional<std::uint64_t> count(Task&& task) {
    const std::optional<std::uint64_t> before = read();
    task();
    const std::optional<std::uint64_t> after = read();
    if (!before || !after) return std::nullopt;
    return *after - *before;
  }

 private:
  std::optional<std::uint64_t> read() const;

  int descriptor_ = -1;
};

/// Instructions of this program run with these arguments, counted by valgrind: exact on any
/// machine, and slow. nullopt where valgrind is not installed or the program fails.
std::optional<std::uint64_t> count_by_callgrind(const std::vector<std::string>& words);

/// The count in callgrind's report, "==12== Collected : 3325337".
std::optional<std::uint64_t> parse_callgrind_report(const std::string& report);

}  // namespace cornerd::bench
