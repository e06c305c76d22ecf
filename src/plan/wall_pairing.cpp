// SPDX-License-Identifier: MIT
#include "plan/wall_pairing.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <tuple>

#include "core/map/cell_grid.hpp"
#include "core/map/outline.hpp"
#include "plan/line_merging.hpp"

namespace cornerd::plan {

namespace {

using core::Vec2;

/// Faces of a wall are parallel but for the drawing's rounding.
constexpr double kParallel_rad = core::radians(1);
/// Sheets that are thinner are lines.
constexpr double kThinnest_m = 0.005;
/// Two faces overlap by this share of their distance.
constexpr double kLeastOverlap = 0.5;
constexpr double kShortest_m = 1e-3;
/// A line this near to the surface of a wall is its end, or was drawn twice.
constexpr double kOnSurface_m = 0.01;
/// Pairs of lines near each other that are compared; of a plan's walls each line has some dozens.
/// More would take minutes, and of those that may be one wall more than a gigabyte.
constexpr std::size_t kMaxCompared = 20'000'000;
constexpr std::size_t kMaxCandidates = 5'000'000;
/// Where walls meet, a face is interrupted by as much as the other wall is thick.
constexpr double kJoint = 1.2;

/// A wall between two faces: along a face from `begin` to `end`, `thickness_m` to its left or
/// right.
struct Piece {
  Vec2 origin;
  Vec2 along;
  Vec2 across;  ///< unit vector from the face into the wall
  double begin_m = 0;
  double end_m = 0;
  double thickness_m = 0;

  void extend_to(const Vec2& point) {
    const double at_m = along.dot(point - origin);
    begin_m = std::min(begin_m, at_m);
    end_m = std::max(end_m, at_m);
  }
  core::Wall wall() const {
    const double length_m = end_m - begin_m;
    const Vec2 middle = origin + (begin_m + end_m) / 2 * along + thickness_m / 2 * across;
    const bool is_long = length_m >= thickness_m;
    const Vec2 axis = is_long ? along : across;
    const double width_m = std::min(length_m, thickness_m);
    const double half_m = (std::max(length_m, thickness_m) - width_m) / 2;
    return {middle - half_m * axis, middle + half_m * axis, width_m};
  }
};

/// A part of a line that is a face of a piece.
struct Use {
  double begin_m = 0;
  double end_m = 0;
  std::size_t piece = 0;
};

struct Candidate {
  double apart_m = 0;
  std::uint32_t one = 0;
  std::uint32_t other = 0;
};

class Pairing {
 public:
  Pairing(std::vector<Line> lines, const PairingOptions& options)
      : lines_(std::move(lines)), options_(options), uses_(lines_.size()) {}

  PairedWalls run() {
    for (const Candidate& candidate : candidates()) pair(candidate);
    close_joints();
    PairedWalls result;
    for (const Piece& piece : pieces_) result.walls.push_back(piece.wall());
    result.two_sided = result.walls.size();
    add_single_lines(result);
    return result;
  }

 private:
  [[noreturn]] void refuse_hatching() const {
    throw PlanError(
        "too many of its " + std::to_string(lines_.size()) +
        " lines cross each other or lie side by side: hatching, or noise? Keep only the "
        "layers with walls (--layer), and check --scale");
  }

  /// Parallel lines within reach, the nearest first.
  std::vector<Candidate> candidates() const {
    std::vector<core::Extent> extents;
    for (const Line& line : lines_) {
      extents.push_back(core::Extent::of_segment(line.from, line.to(), options_.thickest_m));
    }
    const core::CellGrid grid(extents);
    std::vector<Candidate> found;
    std::vector<std::uint32_t> near;
    std::size_t compared = 0;
    for (std::uint32_t i = 0; i < lines_.size(); ++i) {
      grid.collect(core::Extent::of_segment(lines_[i].from, lines_[i].to(), 0), near);
      compared += near.size();
      if (compared > kMaxCompared || found.size() > kMaxCandidates) refuse_hatching();
      for (const std::uint32_t j : near) {
        if (j <= i || std::abs(core::cross(lines_[i].along, lines_[j].along)) > kParallel_rad) {
          continue;
        }
        const Vec2 middle = (lines_[j].from + lines_[j].to()) / 2;
        const double apart_m = std::abs(core::cross(lines_[i].along, middle - lines_[i].from));
        if (apart_m < kThinnest_m || apart_m > options_.thickest_m) continue;
        found.push_back({apart_m, i, j});
      }
    }
    std::sort(found.begin(), found.end(), [](const Candidate& a, const Candidate& b) {
      return std::tie(a.apart_m, a.one, a.other) < std::tie(b.apart_m, b.one, b.other);
    });
    return found;
  }

  /// The parts of a line that are no face yet.
  std::vector<Use> free_parts(std::uint32_t line) const {
    std::vector<Use> parts;
    double begin_m = 0;
    for (const Use& use : uses_[line]) {
      if (use.begin_m > begin_m) parts.push_back({begin_m, use.begin_m, 0});
      begin_m = std::max(begin_m, use.end_m);
    }
    if (begin_m < lines_[line].length_m) parts.push_back({begin_m, lines_[line].length_m, 0});
    return parts;
  }

  void pair(const Candidate& candidate) {
    const Line& one = lines_[candidate.one];
    const Line& other = lines_[candidate.other];
    const double height_m = core::cross(one.along, (other.from + other.to()) / 2 - one.from);
    for (const Use& a : free_parts(candidate.one)) {
      for (const Use& b : free_parts(candidate.other)) {
        const double p_m = one.along.dot(other.at(b.begin_m) - one.from);
        const double q_m = one.along.dot(other.at(b.end_m) - one.from);
        const double begin_m = std::max(a.begin_m, std::min(p_m, q_m));
        const double end_m = std::min(a.end_m, std::max(p_m, q_m));
        if (end_m - begin_m < std::max(kShortest_m, kLeastOverlap * candidate.apart_m)) continue;
        const std::size_t piece = pieces_.size();
        pieces_.push_back({one.from, one.along,
                           std::copysign(1.0, height_m) * core::rotate_left(one.along), begin_m,
                           end_m, candidate.apart_m});
        use(candidate.one, begin_m, end_m, piece);
        const double u_m = other.along.dot(one.at(begin_m) - other.from);
        const double v_m = other.along.dot(one.at(end_m) - other.from);
        use(candidate.other, std::min(u_m, v_m), std::max(u_m, v_m), piece);
        return pair(candidate);  // with what is left of both
      }
    }
  }

  void use(std::uint32_t line, double begin_m, double end_m, std::size_t piece) {
    const Use added{begin_m, end_m, piece};
    auto& uses = uses_[line];
    const auto by_begin = [](const Use& a, const Use& b) { return a.begin_m < b.begin_m; };
    uses.insert(std::upper_bound(uses.begin(), uses.end(), added, by_begin), added);
  }

  /// At corners and where walls meet, one face is longer than the other.
  void close_joints() {
    double thickest_m = 0;
    for (const Piece& piece : pieces_) thickest_m = std::max(thickest_m, piece.thickness_m);
    for (std::uint32_t i = 0; i < lines_.size(); ++i) {
      const std::vector<Use> uses = uses_[i];
      for (const Use& part : free_parts(i)) {
        if (uses.empty() || part.end_m - part.begin_m > kJoint * thickest_m) continue;
        for (const Use& use : uses) {
          const bool is_before = std::abs(use.end_m - part.begin_m) < kShortest_m;
          const bool is_behind = std::abs(use.begin_m - part.end_m) < kShortest_m;
          if (!is_before && !is_behind) continue;
          Piece& piece = pieces_[use.piece];
          piece.extend_to(lines_[i].at(is_before ? part.end_m : part.begin_m));
          this->use(i, part.begin_m, part.end_m, use.piece);
          break;
        }
      }
    }
  }

  void add_single_lines(PairedWalls& result) const {
    std::vector<core::Extent> extents;
    std::vector<core::WallBox> boxes;
    for (const core::Wall& wall : result.walls) {
      boxes.emplace_back(wall);
      boxes.back().half_length_m += kOnSurface_m;
      boxes.back().half_width_m += kOnSurface_m;
      extents.push_back(boxes.back().extent());
    }
    const core::CellGrid grid(extents);
    const auto is_covered = [&](const Vec2& point) {
      const auto near = grid.at(point);
      return std::any_of(near.begin(), near.end(), [&](std::uint32_t i) {
        const Vec2 local = boxes[i].to_local(point).cwiseAbs();
        return local.x() <= boxes[i].half_length_m && local.y() <= boxes[i].half_width_m;
      });
    };
    for (std::uint32_t i = 0; i < lines_.size(); ++i) {
      for (const Use& part : free_parts(i)) {
        if (part.end_m - part.begin_m < kShortest_m) continue;
        const Vec2 from = lines_[i].at(part.begin_m);
        const Vec2 to = lines_[i].at(part.end_m);
        if (is_covered(from) && is_covered((from + to) / 2) && is_covered(to)) continue;
        result.walls.push_back({from, to, options_.thin_m});
      }
    }
  }

  std::vector<Line> lines_;
  const PairingOptions& options_;
  std::vector<std::vector<Use>> uses_;  ///< of each line, in order
  std::vector<Piece> pieces_;
};

}  // namespace

PairedWalls pair_walls(std::span<const DrawnLine> lines, const PairingOptions& options) {
  return Pairing(merge_lines(lines), options).run();
}

}  // namespace cornerd::plan
