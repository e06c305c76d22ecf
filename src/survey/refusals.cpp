// SPDX-License-Identifier: MIT
#include "survey/refusals.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

namespace cornerd::survey {
namespace {

/// Of all turns: what the lidar alone may have to guess.
constexpr double kMostGuessed = 0.02;

bool are_few(std::span<const std::size_t> turns, const RecordedDrive& recorded) {
  return static_cast<double>(turns.size()) <= kMostGuessed * static_cast<double>(recorded.size());
}

[[noreturn]] void refuse_turns(const RecordedDrive& recorded, std::span<const std::size_t> turns,
                               const std::string& what, const std::string& advice) {
  const double first_s = core::to_seconds(recorded.start_ns(turns.front()) - recorded.start_ns(0));
  throw std::invalid_argument("without odometry, " + std::to_string(turns.size()) + " of " +
                              std::to_string(recorded.size()) + " turns see " + what +
                              ", the first " + std::to_string(std::llround(first_s)) +
                              " s after the start" + advice);
}

}  // namespace

void refuse_too_few_turns(const RecordedDrive& recorded, std::size_t needed) {
  if (recorded.size() >= needed) return;
  if (recorded.size() == 0) throw std::invalid_argument("not one whole turn of a lidar in it");
  throw std::invalid_argument("whole turns of a lidar in it: " + std::to_string(recorded.size()) +
                              "; a wall has to be seen in " + std::to_string(needed));
}

void refuse_without_overlap(const RecordedDrive& recorded, const MappedDrive& drive) {
  if (drive.has_odometry || are_few(drive.strange_turns, recorded)) return;
  refuse_turns(recorded, drive.strange_turns, "too little of what was seen before them",
               "; drive more slowly there, or record the odometry too");
}

void refuse_unchecked_guesses(const RecordedDrive& recorded, std::span<const std::size_t> blind,
                              std::span<const LoopReport> loops) {
  if (are_few(blind, recorded)) return;
  for (const LoopReport& loop : loops) {
    const auto inside = std::upper_bound(blind.begin(), blind.end(), loop.earlier);
    if (loop.closed() && inside != blind.end() && *inside < loop.later) return;
  }
  refuse_turns(recorded, blind, "walls that tell nothing of the way along them",
               ", and no loop was closed that would tell it; record the odometry too");
}

}  // namespace cornerd::survey
