// SPDX-License-Identifier: MIT
// Drives that give no map, and why. All throw std::invalid_argument.
#pragma once

#include <cstddef>
#include <span>

#include "core/map/wall_map.hpp"
#include "survey/drive_mapper.hpp"
#include "survey/loop_closing.hpp"
#include "survey/recorded_drive.hpp"
#include "survey/seen_through.hpp"

namespace cornerd::survey {

/// Where a wall has to be seen in `needed` turns to be believed.
void refuse_too_few_scans(const RecordedDrive& recorded, std::size_t needed);

/// Without odometry nothing else tells the way: a drive that lost it gives no map.
void refuse_without_overlap(const RecordedDrive& recorded, const MappedDrive& drive);

/// Where the robot went while neither turns nor readings came, nobody knows.
void refuse_pauses(const RecordedDrive& recorded, const MappedDrive& drive);

/// Where walls along the way are all that is seen, the length of the way is a guess: only a place
/// beyond that is recognised again can show that it was good enough.
void refuse_unchecked_guesses(const RecordedDrive& recorded, std::span<const std::size_t> blind,
                              std::span<const LoopReport> loops);

/// Whether so many metres that lie behind other walls are more than what moved explains.
bool are_walls_doubled(double doubled_m, std::span<const core::Wall> walls);

/// Without odometry, where walls are mapped twice, turns were placed beside where they were.
void refuse_doubled_walls(double doubled_m, std::span<const core::Wall> walls);

/// Whether rays went through more of the walls than the noise of the poses explains.
bool are_walls_seen_through(const SeenThrough& through);

/// Where rays went through more than what moves explains, at more than one place, the map is of
/// places laid over each other.
void refuse_seen_through(const SeenThrough& through);

}  // namespace cornerd::survey
