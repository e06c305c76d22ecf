// SPDX-License-Identifier: MIT
#include "survey/seen_through.hpp"

#include <cstdint>

namespace cornerd::survey {
namespace {

/// Fewer rays are outliers, and of few turns.
constexpr std::uint32_t kLeastPasses = 10;
/// Of the rays that ended there.
constexpr double kLeastPassShare = 0.05;
/// Cells in a row.
constexpr std::size_t kLeastCells = 10;

bool contradicts_itself(const FaceEvidence& seen, std::size_t cell) {
  return seen.passes(cell) >= kLeastPasses &&
         seen.passes(cell) > kLeastPassShare * static_cast<double>(seen.hits(cell));
}

}  // namespace

SeenThrough seen_through(const std::vector<FaceEvidence>& evidence,
                         const std::vector<WallPiece>& pieces) {
  SeenThrough sum;
  for (const WallPiece& piece : pieces) {
    const FaceEvidence& seen = evidence[piece.face];
    sum.of_m += piece.length_m();
    std::size_t run = 0;
    const auto close = [&] {
      if (run >= kLeastCells) {
        sum.length_m += FaceEvidence::kCell_m * static_cast<double>(run);
        ++sum.places;
      }
      run = 0;
    };
    for (std::size_t cell = 0; cell < seen.size(); ++cell) {
      const double middle_m = seen.along_of(cell) + FaceEvidence::kCell_m / 2;
      if (middle_m < piece.begin_m || middle_m > piece.end_m) continue;
      if (contradicts_itself(seen, cell)) {
        ++run;
      } else {
        close();
      }
    }
    close();
  }
  return sum;
}

}  // namespace cornerd::survey
