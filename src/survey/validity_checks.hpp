// SPDX-License-Identifier: MIT
// Validity checks of a survey. A check_...() that fails throws std::invalid_argument with the
// reason.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "core/map/wall_map.hpp"
#include "survey/drive_mapper.hpp"
#include "survey/loop_closure.hpp"
#include "survey/recorded_drive.hpp"
#include "survey/wall_piece.hpp"

namespace cornerd::survey {

/// Length (m) of the pieces that lie behind another one with the same normal, which would have
/// hidden them. Small where things moved; whole rooms where the trajectory was lost.
double duplicate_walls_m(const MappedDrive& drive, const std::vector<FaceEvidence>& evidence,
                         const std::vector<WallPiece>& pieces);

/// Parts of the wall faces that some rays ended on and others went through. In a correct map these
/// are things that moved. Where two places are mapped over each other, rays of the one go through
/// walls of the other.
struct FreeSpaceConflicts {
  double length_m = 0;
  std::size_t places = 0;  ///< separate parts
  double of_m = 0;         ///< length of all wall faces
  double share() const { return of_m > 0 ? length_m / of_m : 0; }
};

/// Parts shorter than 0.2 m are not counted: pose noise blurs the edges of walls.
FreeSpaceConflicts free_space_conflicts(const std::vector<FaceEvidence>& evidence,
                                        const std::vector<WallPiece>& pieces);

/// At least `needed` scans.
void check_scan_count(const RecordedDrive& recorded, std::size_t needed);

/// Without odometry: at most 2 % of the scans are unmatched.
void check_overlap(const RecordedDrive& recorded, const MappedDrive& drive);

/// No scan after a pause of lidar and odometry shows another place than the one before it.
void check_pauses(const RecordedDrive& recorded, const MappedDrive& drive);

/// Without odometry: at most 2 % of the scans are degenerate, or a closed loop spans one of them.
void check_degenerate_scans(const RecordedDrive& recorded, std::span<const std::size_t> degenerate,
                            std::span<const LoopReport> loops);

/// More duplicate walls than moved objects cause: 1.2 % of all walls and 0.5 m.
bool has_duplicate_walls(double duplicate_m, std::span<const core::Wall> walls);
/// Without odometry: no more duplicate walls than that.
void check_duplicate_walls(double duplicate_m, std::span<const core::Wall> walls);

/// More than pose noise causes: 0.4 % of the wall faces.
bool has_free_space_conflicts(const FreeSpaceConflicts& conflicts);
/// At most 6 % of the wall faces, 0.6 m, or one place.
void check_free_space_conflicts(const FreeSpaceConflicts& conflicts);

}  // namespace cornerd::survey
