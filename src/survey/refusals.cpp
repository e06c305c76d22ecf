// SPDX-License-Identifier: MIT
#include "survey/refusals.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <stdexcept>
#include <string>

namespace cornerd::survey {
namespace {

/// Of all turns: what the lidar alone may have to guess.
constexpr double kMostGuessed = 0.02;
/// Of the length of all walls: in maps that are right up to 0.002 in simulation and 0.009 among
/// chair legs, in those that were torn from 0.014 on.
constexpr double kMostDoubled = 0.012;
constexpr double kFewDoubled_m = 0.5;
/// Of the sides of all walls: in maps that are right 0 in simulation, and 0.02 to 0.033 in a house
/// that a robot with slipping tracks drove through; in those of drives that do not fit together
/// from 0.023 on, and from 0.07 on where the robot was carried.
constexpr double kNothingThrough = 0.004;
constexpr double kMostThrough = 0.06;
constexpr double kFewThrough_m = 0.6;

bool are_few(std::span<const std::size_t> scans, const RecordedDrive& recorded) {
  return static_cast<double>(scans.size()) <= kMostGuessed * static_cast<double>(recorded.size());
}

std::string with_a_tenth(double value) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.1f", value);
  return text.data();
}

[[noreturn]] void refuse_scans(const RecordedDrive& recorded, std::span<const std::size_t> scans,
                               const std::string& what, const std::string& advice) {
  const double first_s = core::to_seconds(recorded.start_ns(scans.front()) - recorded.start_ns(0));
  throw std::invalid_argument("without odometry, " + std::to_string(scans.size()) + " of " +
                              std::to_string(recorded.size()) + " turns see " + what +
                              ", the first " + std::to_string(std::llround(first_s)) +
                              " s after the start" + advice);
}

}  // namespace

void refuse_too_few_scans(const RecordedDrive& recorded, std::size_t needed) {
  if (recorded.size() >= needed) return;
  if (recorded.size() == 0) throw std::invalid_argument("not one whole turn of a lidar in it");
  throw std::invalid_argument("whole turns of a lidar in it: " + std::to_string(recorded.size()) +
                              "; a wall has to be seen in " + std::to_string(needed));
}

void refuse_without_overlap(const RecordedDrive& recorded, const MappedDrive& drive) {
  if (drive.has_odometry || are_few(drive.unmatched_scans, recorded)) return;
  refuse_scans(recorded, drive.unmatched_scans, "too little of what was seen before them",
               "; drive more slowly there, or record the odometry too");
}

void refuse_pauses(const RecordedDrive& recorded, const MappedDrive& drive) {
  if (drive.lost_scans.empty()) return;
  const std::size_t scan = drive.lost_scans.front();
  const auto after_start = [&](core::TimeNs t_ns) {
    return with_a_tenth(core::to_seconds(t_ns - recorded.start_ns(0)));
  };
  throw std::invalid_argument("no turn of the lidar from " +
                              after_start(recorded.end_ns(scan - 1)) + " to " +
                              after_start(recorded.start_ns(scan)) +
                              " s after the start, no odometry that tells how the robot moved "
                              "meanwhile, and it sees another place then; survey the parts one by "
                              "one, or record anew");
}

void refuse_unchecked_guesses(const RecordedDrive& recorded, std::span<const std::size_t> blind,
                              std::span<const LoopReport> loops) {
  if (are_few(blind, recorded)) return;
  for (const LoopReport& loop : loops) {
    const auto inside = std::upper_bound(blind.begin(), blind.end(), loop.earlier);
    if (loop.closed() && inside != blind.end() && *inside < loop.later) return;
  }
  refuse_scans(recorded, blind, "walls that tell nothing of the way along them",
               ", and no loop was closed that would tell it; record the odometry too");
}

bool are_walls_doubled(double doubled_m, std::span<const core::Wall> walls) {
  double all_m = 0;
  for (const core::Wall& wall : walls) all_m += (wall.to - wall.from).norm();
  return doubled_m > std::max(kFewDoubled_m, kMostDoubled * all_m);
}

void refuse_doubled_walls(double doubled_m, std::span<const core::Wall> walls) {
  if (!are_walls_doubled(doubled_m, walls)) return;
  throw std::invalid_argument(
      "without odometry, turns do not overlap enough: " + with_a_tenth(doubled_m) +
      " m of walls would have been mapped twice, one behind the other; drive more slowly, or "
      "record "
      "the odometry too");
}

bool are_walls_seen_through(const SeenThrough& through) {
  return through.share() > kNothingThrough;
}

void refuse_seen_through(const SeenThrough& through) {
  // One place is a door or a cupboard that moved.
  if (through.places < 2 || through.length_m < kFewThrough_m || through.share() < kMostThrough) {
    return;
  }
  std::array<char, 128> text{};
  std::snprintf(text.data(), text.size(),
                "rays went through %.1f of %.1f m of the walls' sides (%.1f %%)", through.length_m,
                through.of_m, 100 * through.share());
  throw std::invalid_argument(
      "the recording does not fit together: " + std::string(text.data()) +
      ", so that places would have been laid over each other; record anew, in one go, without "
      "carrying the robot or moving doors and furniture, and begin each further recording where "
      "the one before ended; or measure lidar.noise, where the lidar is much worse than it says");
}

}  // namespace cornerd::survey
