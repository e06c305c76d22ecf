// SPDX-License-Identifier: MIT
#include "survey/doubled_walls.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace cornerd::survey {
namespace {

/// What is nearer may be one wall that the sensor sees now here, now there.
constexpr double kLeastApart_m = 0.07;
constexpr double kMostApart_m = 0.5;
constexpr double kMaxRotation_rad = core::radians(12);
/// What is so near to the end of the front one, as a multiple of how far it is behind it, was seen
/// past that end.
constexpr double kPastTheEnd = 2;
constexpr double kEnd_m = 0.1;

/// Metres of `back` behind `front` at which rays ended on both.
double hidden_m(const MappedDrive& drive, const std::vector<FaceEvidence>& evidence,
                const WallPiece& front, const WallPiece& back) {
  const MappedFace& before = drive.faces[front.face];
  const MappedFace& behind = drive.faces[back.face];
  if (std::abs(core::angle_between(before.normal_rad(), behind.normal_rad())) > kMaxRotation_rad) {
    return 0;
  }
  const FaceEvidence& seen = evidence[back.face];
  std::size_t cells = 0;
  for (std::size_t cell = 0; cell < seen.size(); ++cell) {
    const double along_m = seen.along_of(cell) + FaceEvidence::kCell_m / 2;
    if (along_m < back.begin_m || along_m > back.end_m || !seen.is_wall(cell)) continue;
    const core::Vec2 place = behind.at(along_m);
    const double depth_m = -before.height_of(place);
    if (depth_m < kLeastApart_m || depth_m > kMostApart_m) continue;
    const double front_m = before.along_of(place);
    const double end_m = kEnd_m + kPastTheEnd * depth_m;
    if (front_m < front.begin_m + end_m || front_m > front.end_m - end_m) continue;
    if (evidence[front.face].hits_at(front_m) > 0) ++cells;
  }
  return FaceEvidence::kCell_m * static_cast<double>(cells);
}

}  // namespace

double doubled_walls_m(const MappedDrive& drive, const std::vector<FaceEvidence>& evidence,
                       const std::vector<WallPiece>& pieces) {
  double doubled_m = 0;
  for (const WallPiece& back : pieces) {
    double most_m = 0;
    for (const WallPiece& front : pieces) {
      if (front.face != back.face)
        most_m = std::max(most_m, hidden_m(drive, evidence, front, back));
    }
    doubled_m += most_m;
  }
  return doubled_m;
}

}  // namespace cornerd::survey
