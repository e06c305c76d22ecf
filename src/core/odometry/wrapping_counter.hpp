// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

namespace cornerd::core {

/// The way from one count to the next by the shorter way round, for a counter that goes from
/// `ceiling` to 0. Signed and unsigned readings of the same counter give the same. Any input.
inline std::int64_t count_difference(std::int64_t from, std::int64_t to, std::int64_t ceiling) {
  const std::uint64_t way = static_cast<std::uint64_t>(to) - static_cast<std::uint64_t>(from);
  if (ceiling <= 0) return static_cast<std::int64_t>(way);
  const auto span = static_cast<std::uint64_t>(ceiling) + 1;
  // A signed difference may be negative; modulo is taken of its size.
  const auto signed_way = static_cast<std::int64_t>(way);
  const std::uint64_t size = signed_way < 0 ? 0 - way : way;
  const std::uint64_t rest = size % span;
  const std::uint64_t forward = signed_way < 0 && rest != 0 ? span - rest : rest;
  return forward > span / 2 ? static_cast<std::int64_t>(forward) - static_cast<std::int64_t>(span)
                            : static_cast<std::int64_t>(forward);
}

}  // namespace cornerd::core
