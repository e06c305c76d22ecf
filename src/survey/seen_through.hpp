// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <vector>

#include "survey/wall_piece.hpp"

namespace cornerd::survey {

/// Of the sides of all walls, what rays ended on and others went through. In a map that is right
/// that is what moved; where a drive goes on elsewhere than it left off, places are laid over each
/// other, and from the one many rays go through the walls of the other.
struct SeenThrough {
  double length_m = 0;
  std::size_t places = 0;  ///< stretches that it consists of
  double of_m = 0;         ///< of the sides of all walls
  double share() const { return of_m > 0 ? length_m / of_m : 0; }
};

/// Counts no stretch shorter than 0.2 m: the edges of walls are blurred by the noise of the poses.
SeenThrough seen_through(const std::vector<FaceEvidence>& evidence,
                         const std::vector<WallPiece>& pieces);

}  // namespace cornerd::survey
