// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <optional>

#include "survey/wall_piece.hpp"

namespace cornerd::survey {
namespace {

/// A smaller angle gives no certain corner.
const double kMinSine = std::sin(core::radians(15));
/// A corner may lie this far before the last hit: cells are 2 cm long, and some returns of the next
/// wall lie on this line.
constexpr double kBack_m = 0.08;
/// Open length allowed between a piece and its corner: the cell at the wall's end.
constexpr double kOpen_m = 0.03;
/// Penalty that prefers a corner with an end to one with a side.
constexpr double kSidePenalty_m = 0.06;

struct Join {
  double cost_m = 0;
  std::uint32_t from = 0;  ///< piece that ends here
  std::uint32_t to = 0;    ///< piece that begins here, or whose side is met
  bool at_end = true;      ///< at the end of `from`; at its begin only where `at_side`
  bool at_side = false;
  core::Vec2 point = core::Vec2::Zero();
  double from_unseen_m = 0;
  double to_unseen_m = 0;
};

class CornerJoiner {
 public:
  CornerJoiner(const MappedDrive& drive, const std::vector<FaceEvidence>& evidence,
               const PieceLimits& limits, std::vector<WallPiece>& pieces)
      : drive_(drive), evidence_(evidence), limits_(limits), pieces_(pieces) {}

  void join() {
    for (std::uint32_t a = 0; a < pieces_.size(); ++a) {
      for (std::uint32_t b = 0; b < pieces_.size(); ++b) {
        if (a != b) consider(a, b);
      }
    }
    std::stable_sort(joins_.begin(), joins_.end(),
                     [](const Join& a, const Join& b) { return a.cost_m < b.cost_m; });
    for (const Join& join : joins_) apply(join);
  }

 private:
  const LineLandmark& face_of(std::uint32_t piece) const {
    return drive_.faces[pieces_[piece].face];
  }

  std::optional<core::Vec2> meeting_point(const LineLandmark& a, const LineLandmark& b) const {
    const double sine = core::cross(a.direction(), b.direction());
    if (std::abs(sine) < kMinSine) return std::nullopt;
    const double along_m = core::cross(b.at(0) - a.at(0), b.direction()) / sine;
    return a.at(along_m);
  }

  /// Extension of a piece to the point; negative where it has to be shortened. Nullopt where the
  /// piece cannot reach it.
  std::optional<double> extension_to(std::uint32_t piece, double along_m, bool at_end) const {
    const WallPiece& wall = pieces_[piece];
    const double beyond_m = at_end ? along_m - wall.end_m : wall.begin_m - along_m;
    if (beyond_m > limits_.corner_m || beyond_m < -std::min(kBack_m, wall.length_m() / 2)) {
      return std::nullopt;
    }
    const double from_m = at_end ? wall.end_m : wall.begin_m;
    if (beyond_m > 0 && evidence_[wall.face].open_between(from_m, along_m) > kOpen_m) {
      return std::nullopt;
    }
    return beyond_m;
  }

  void consider(std::uint32_t a, std::uint32_t b) {
    const LineLandmark& one = face_of(a);
    const LineLandmark& other = face_of(b);
    const auto point = meeting_point(one, other);
    if (!point) return;
    const double along_one_m = one.along_of(*point);
    const double along_other_m = other.along_of(*point);
    const auto to_end = extension_to(a, along_one_m, /*at_end=*/true);
    const auto to_begin = extension_to(b, along_other_m, /*at_end=*/false);
    if (to_end && to_begin) {
      joins_.push_back({std::abs(*to_end) + std::abs(*to_begin), a, b, true, false, *point,
                        std::max(*to_end, 0.0), std::max(*to_begin, 0.0)});
    }
    const WallPiece& side = pieces_[b];
    if (along_other_m < side.begin_m || along_other_m > side.end_m) return;
    for (const bool at_end : {true, false}) {
      const auto to_side = extension_to(a, along_one_m, at_end);
      if (!to_side) continue;
      // A wall meets another face from its free side only.
      const double far_m = at_end ? pieces_[a].begin_m : pieces_[a].end_m;
      if (other.height_of(one.at(far_m)) < 0) continue;
      joins_.push_back({std::abs(*to_side) + kSidePenalty_m, a, b, at_end, true, *point,
                        std::max(*to_side, 0.0), 0});
    }
  }

  void apply(const Join& join) {
    PieceEnd& from = join.at_end ? pieces_[join.from].end : pieces_[join.from].begin;
    if (from.neighbour != kNoPiece) return;
    if (join.at_side) {
      from = {join.point, join.to, true, true, join.from_unseen_m};
    } else {
      PieceEnd& to = pieces_[join.to].begin;
      if (to.neighbour != kNoPiece) return;
      const bool concave =
          core::cross(face_of(join.from).direction(), face_of(join.to).direction()) > 0;
      from = {join.point, join.to, concave, false, join.from_unseen_m};
      to = {join.point, join.from, concave, false, join.to_unseen_m};
      pieces_[join.to].begin_m = face_of(join.to).along_of(join.point);
    }
    const double along_m = face_of(join.from).along_of(join.point);
    (join.at_end ? pieces_[join.from].end_m : pieces_[join.from].begin_m) = along_m;
  }

  const MappedDrive& drive_;
  const std::vector<FaceEvidence>& evidence_;
  const PieceLimits& limits_;
  std::vector<WallPiece>& pieces_;
  std::vector<Join> joins_;
};

}  // namespace

void join_corners(const MappedDrive& drive, const std::vector<FaceEvidence>& evidence,
                  const PieceLimits& limits, std::vector<WallPiece>& pieces) {
  CornerJoiner(drive, evidence, limits, pieces).join();
}

}  // namespace cornerd::survey
