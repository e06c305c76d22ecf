// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace cornerd::bench {

/// How many instructions this program executes when it is called with these words, as valgrind
/// counts them: exactly, on any machine, and slowly. nullopt where valgrind is not installed or
/// the program fails.
std::optional<std::uint64_t> count_by_callgrind(const std::vector<std::string>& words);

/// The figure in callgrind's report, "==12== Collected : 3325337".
std::optional<std::uint64_t> parse_callgrind_report(const std::string& report);

}  // namespace cornerd::bench
