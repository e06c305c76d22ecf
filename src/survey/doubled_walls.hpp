// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "survey/wall_piece.hpp"

namespace cornerd::survey {

/// Metres of the pieces that lie behind another one that looks the same way and would have hidden
/// them. Where things moved that is little; where the way was lost and went on beside itself it is
/// walls of whole rooms.
double doubled_walls_m(const MappedDrive& drive, const std::vector<FaceEvidence>& evidence,
                       const std::vector<WallPiece>& pieces);

}  // namespace cornerd::survey
