// SPDX-License-Identifier: MIT
#include "survey/wall_building.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

namespace cornerd::survey {
namespace {

/// A thinner pair is one face with range errors.
constexpr double kThinnest_m = 0.004;
constexpr double kMinOverlap_m = 0.04;
/// A wall enters the one it ends on by this, so that no ray passes through the joint.
constexpr double kInto_m = 0.001;
/// Shortest rest of a face beside its solids that becomes a wall.
constexpr double kMinRest_m = 0.02;
/// A face whose length differs from the thickness by less than this closes the wall's end.
constexpr double kEndFace_m = 0.05;

struct Interval {
  double begin_m;
  double end_m;
  double length_m() const { return end_m - begin_m; }
};

/// The longest part of `whole` that `taken` does not cover.
Interval longest_rest(const Interval& whole, std::span<const Interval> taken) {
  Interval best{whole.begin_m, whole.begin_m};
  double from_m = whole.begin_m;
  std::vector<Interval> sorted(taken.begin(), taken.end());
  std::sort(sorted.begin(), sorted.end(),
            [](const Interval& a, const Interval& b) { return a.begin_m < b.begin_m; });
  sorted.push_back({whole.end_m, whole.end_m});
  for (const Interval& next : sorted) {
    const Interval gap{from_m, std::min(next.begin_m, whole.end_m)};
    if (gap.length_m() > best.length_m()) best = gap;
    from_m = std::max(from_m, next.end_m);
  }
  return best;
}

class Builder {
 public:
  Builder(const MappedDrive& drive, std::span<const WallPiece> pieces)
      : drive_(drive), pieces_(pieces), taken_(pieces.size()), closed_(pieces.size(), false) {}

  std::vector<core::Wall> build(std::span<const WallPair> pairs) {
    for (const WallPair& pair : pairs) add_solid(pair);
    for (std::uint32_t i = 0; i < pieces_.size(); ++i) {
      if (!closed_[i]) add_rest(i);
    }
    return std::move(walls_);
  }

 private:
  const LineLandmark& face_of(std::uint32_t piece) const {
    return drive_.faces[pieces_[piece].face];
  }

  /// The piece that closes the wall between its two ends, if any.
  std::optional<std::uint32_t> end_face(const PieceEnd& out, const PieceEnd& back,
                                        double thickness_m, bool forward) const {
    if (out.neighbour == kNoPiece || out.within || out.is_concave) return std::nullopt;
    const WallPiece& face = pieces_[out.neighbour];
    if (std::abs(face.length_m() - thickness_m) > kEndFace_m) return std::nullopt;
    const PieceEnd& far = forward ? face.end : face.begin;
    const bool meets = back.neighbour == out.neighbour && !back.within;
    const bool loose = far.neighbour == kNoPiece || meets;
    return loose ? std::optional(out.neighbour) : std::nullopt;
  }

  void add_solid(const WallPair& pair) {
    const WallPiece& one = pieces_[pair.one];
    const WallPiece& other = pieces_[pair.other];
    const LineLandmark& front = face_of(pair.one);
    const LineLandmark& back = face_of(pair.other);
    // The axis: half-way between both faces, in their mean direction.
    const double rotation_rad =
        core::angle_between(front.normal_rad(), back.normal_rad() + core::kPi) / 2;
    const core::Vec2 normal = core::unit_vector(front.normal_rad() + rotation_rad);
    const core::Vec2 direction = along(normal);
    const core::Vec2 centre = front.at((pair.begin_m + pair.end_m) / 2);
    const core::Vec2 opposite = back.at(back.along_of(centre));
    const double thickness_m = normal.dot(centre - opposite);
    const core::Vec2 middle = (centre + opposite) / 2;
    const auto on_axis = [&](const core::Vec2& point) { return direction.dot(point - middle); };

    const double extra_m = 1.2 * thickness_m + 0.02;
    const Interval both{on_axis(front.at(pair.begin_m)), on_axis(front.at(pair.end_m))};
    const double begin_m =
        end_of_solid(one.begin, other.end, both.begin_m, extra_m, -1, thickness_m, on_axis,
                     pair.begin_m <= one.begin_m + extra_m);
    const double end_m = end_of_solid(one.end, other.begin, both.end_m, extra_m, 1, thickness_m,
                                      on_axis, pair.end_m >= one.end_m - extra_m);
    core::Wall wall;
    wall.thickness_m = thickness_m;
    wall.is_open = {is_open(one.begin, other.end, begin_m, extra_m, on_axis),
                    is_open(one.end, other.begin, end_m, extra_m, on_axis)};
    if (end_m - begin_m >= thickness_m) {
      wall.from = middle + (begin_m + thickness_m / 2) * direction;
      wall.to = middle + (end_m - thickness_m / 2) * direction;
    } else {
      // Thicker than long: as a wall that runs across.
      const core::Vec2 place = middle + (begin_m + end_m) / 2 * direction;
      const double half_m = (thickness_m - (end_m - begin_m)) / 2;
      wall.is_open = {};
      wall.thickness_m = end_m - begin_m;
      wall.from = place - half_m * normal;
      wall.to = place + half_m * normal;
    }
    walls_.push_back(wall);
    const auto take = [&](std::uint32_t piece) {
      const LineLandmark& face = face_of(piece);
      const double a = face.along_of(middle + begin_m * direction);
      const double b = face.along_of(middle + end_m * direction);
      taken_[piece].push_back({std::min(a, b), std::max(a, b)});
    };
    take(pair.one);
    take(pair.other);
  }

  /// Where the solid ends on the axis. `sign`: 1 at the end of `out`'s piece, -1 at its begin.
  template <typename OnAxis>
  double end_of_solid(const PieceEnd& out, const PieceEnd& back, double both_m, double extra_m,
                      int sign, double thickness_m, const OnAxis& on_axis, bool is_end) {
    if (!is_end) return both_m;
    const auto closing =
        sign > 0 ? end_face(out, back, thickness_m, true) : end_face(out, back, thickness_m, false);
    const auto closing_back =
        sign > 0 ? end_face(back, out, thickness_m, false) : end_face(back, out, thickness_m, true);
    if (closing || closing_back) {
      const std::uint32_t piece = closing ? *closing : *closing_back;
      closed_[piece] = true;
      const LineLandmark& face = face_of(piece);
      return on_axis(face.at((pieces_[piece].begin_m + pieces_[piece].end_m) / 2));
    }
    double reached_m = both_m;
    for (const PieceEnd* end : {&out, &back}) {
      const double end_m = on_axis(end->point);
      if (sign * (end_m - both_m) > extra_m) continue;
      const double into_m = end->neighbour != kNoPiece && end->is_concave ? sign * kInto_m : 0;
      const double candidate_m = end_m + into_m;
      if (sign * (candidate_m - reached_m) > 0) reached_m = candidate_m;
    }
    return reached_m;
  }

  /// All faces that end at the end of a solid end where sight did.
  template <typename OnAxis>
  static bool is_open(const PieceEnd& out, const PieceEnd& back, double end_m, double extra_m,
                      const OnAxis& on_axis) {
    const auto is_here = [&](const PieceEnd& end) {
      return std::abs(on_axis(end.point) - end_m) <= extra_m;
    };
    return (is_here(out) || is_here(back)) && (!is_here(out) || out.is_open) &&
           (!is_here(back) || back.is_open);
  }

  void add_rest(std::uint32_t index) {
    const WallPiece& piece = pieces_[index];
    const LineLandmark& face = face_of(index);
    std::vector<Interval> taken = taken_[index];
    std::sort(taken.begin(), taken.end(),
              [](const Interval& a, const Interval& b) { return a.begin_m < b.begin_m; });
    taken.push_back({piece.end_m, piece.end_m});
    double from_m = piece.begin_m;
    for (const Interval& next : taken) {
      const double to_m = std::min(next.begin_m, piece.end_m);
      if (to_m - from_m > kMinRest_m) {
        // Into the solid beside it, or to the corner.
        const double begin_m = from_m > piece.begin_m ? from_m - kInto_m : from_m;
        const double end_m = to_m < piece.end_m ? to_m + kInto_m : to_m;
        walls_.push_back({face.at(begin_m), face.at(end_m), 0});
        walls_.back().is_open = {from_m == piece.begin_m && piece.begin.is_open,
                                 to_m == piece.end_m && piece.end.is_open};
      }
      from_m = std::max(from_m, next.end_m);
    }
  }

  const MappedDrive& drive_;
  std::span<const WallPiece> pieces_;
  std::vector<std::vector<Interval>> taken_;  ///< of each piece, by solids
  std::vector<bool> closed_;                  ///< the piece closes the end of a solid
  std::vector<core::Wall> walls_;
};

}  // namespace

std::vector<WallPair> pair_sides(const MappedDrive& drive, std::span<const WallPiece> pieces,
                                 const SolidLimits& limits) {
  std::vector<WallPair> candidates;
  const double least_cosine = std::cos(limits.rotation_rad);
  for (std::uint32_t a = 0; a < pieces.size(); ++a) {
    for (std::uint32_t b = a + 1; b < pieces.size(); ++b) {
      const LineLandmark& one = drive.faces[pieces[a].face];
      const LineLandmark& other = drive.faces[pieces[b].face];
      if (one.normal().dot(other.normal()) > -least_cosine) continue;
      const double from_m = one.along_of(other.at(pieces[b].end_m));
      const double to_m = one.along_of(other.at(pieces[b].begin_m));
      const Interval both{std::max(from_m, pieces[a].begin_m), std::min(to_m, pieces[a].end_m)};
      if (both.length_m() < kMinOverlap_m) continue;
      const core::Vec2 centre = one.at((both.begin_m + both.end_m) / 2);
      const double behind_m = -other.height_of(centre);
      if (behind_m < kThinnest_m || behind_m > limits.thickness_m) continue;
      candidates.push_back({a, b, behind_m, both.begin_m, both.end_m});
    }
  }
  std::stable_sort(candidates.begin(), candidates.end(), [](const WallPair& x, const WallPair& y) {
    return x.thickness_m < y.thickness_m;
  });

  std::vector<WallPair> pairs;
  std::vector<std::vector<Interval>> taken(pieces.size());
  for (WallPair pair : candidates) {
    const LineLandmark& one = drive.faces[pieces[pair.one].face];
    const LineLandmark& other = drive.faces[pieces[pair.other].face];
    const Interval rest = longest_rest({pair.begin_m, pair.end_m}, taken[pair.one]);
    const double back_begin_m = other.along_of(one.at(rest.end_m));
    const double back_end_m = other.along_of(one.at(rest.begin_m));
    const Interval back = longest_rest({back_begin_m, back_end_m}, taken[pair.other]);
    pair.begin_m = one.along_of(other.at(back.end_m));
    pair.end_m = one.along_of(other.at(back.begin_m));
    if (pair.end_m - pair.begin_m < kMinOverlap_m) continue;
    taken[pair.one].push_back({pair.begin_m, pair.end_m});
    taken[pair.other].push_back(back);
    pairs.push_back(pair);
  }
  return pairs;
}

std::vector<FaceConstraint> parallel_constraints(const MappedDrive& drive,
                                                 std::span<const WallPiece> pieces,
                                                 std::span<const WallPair> pairs) {
  // A larger angle between both faces is intended.
  constexpr double kParallel_rad = core::radians(0.7);
  constexpr double kGateSigmas = 3;
  constexpr double kConstraintSigma_rad = core::radians(0.02);
  std::vector<FaceConstraint> constraints;
  for (const WallPair& pair : pairs) {
    FaceConstraint constraint;
    constraint.one = pieces[pair.one].face;
    constraint.other = pieces[pair.other].face;
    constraint.rotation_rad = core::kPi;
    constraint.sigma_rad = kConstraintSigma_rad;
    const LineLandmark& one = drive.faces[constraint.one];
    const LineLandmark& other = drive.faces[constraint.other];
    const double rotation_rad =
        core::angle_between(one.normal_rad() + core::kPi, other.normal_rad());
    const double sigma_rad = std::sqrt(one.covariance()(0, 0) + other.covariance()(0, 0));
    if (std::abs(rotation_rad) < kParallel_rad + kGateSigmas * sigma_rad)
      constraints.push_back(constraint);
  }
  return constraints;
}

std::vector<core::Wall> build_walls(const MappedDrive& drive, std::span<const WallPiece> pieces,
                                    std::span<const WallPair> pairs) {
  return Builder(drive, pieces).build(pairs);
}

BuiltWalls build_walls_of(const MappedDrive& drive, const std::vector<FaceEvidence>& evidence,
                          const WallLimits& limits, std::vector<DroppedPiece>& dropped) {
  BuiltWalls built;
  built.pieces = cut_pieces(drive, evidence, limits.pieces, dropped);
  trim_crossings(drive, limits.pieces, built.pieces, dropped);
  join_corners(drive, evidence, limits.pieces, built.pieces);
  mark_open_ends(evidence, built.pieces);
  drop_isolated(drive, limits.pieces, built.pieces, dropped);
  built.walls = build_walls(drive, built.pieces, pair_sides(drive, built.pieces, limits.solids));
  return built;
}

}  // namespace cornerd::survey
