// SPDX-License-Identifier: MIT
#include "gridmap/line_search.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "core/breakpoint/line_fit.hpp"
#include "gridmap/solids.hpp"
#include "gridmap/surface.hpp"

namespace cornerd::gridmap {
namespace {

using core::Vec2;

/// A side belongs to lines that it is parallel to within 60 degrees.
constexpr double kMinFacing = 0.5;
/// Cells around a side whose sides give the direction of a first line.
constexpr std::int64_t kSeedRadius = 10;
/// Score of a slice of a line: an occupied one is 1. A wall is occupied in 60 % of the slices that
/// are free or occupied, and continues beyond unknown ones for at least half their length.
constexpr double kFreeScore = -1.5;
constexpr double kUnknownScore = -0.5;
/// Largest share of occupied cells before a line, of its score for each cell of length.
constexpr double kMaxBefore = 0.2;
/// Of the distances between an oblique line and the sides of cells along it: uniform.
constexpr double kRasterVariance = 1.0 / 12;
/// Of a corner in a raster from where its faces end, beside their tolerance.
constexpr double kCornerRadius = 2;
constexpr int kFitRounds = 4;

struct Seed {
  Side side;
  SurfaceLine line;
  double score = 0;
};

struct Segment {
  SurfaceLine line;
  Interval extent;
  double score = 0;

  GridFace face() const {
    return {line.at + extent.begin * line.direction, line.at + extent.end * line.direction,
            line.direction};
  }
};

class LineSearch {
 public:
  LineSearch(const OccupancyGrid& grid, const LineSearchOptions& options)
      : surface_(grid), options_(options) {}

  MappedLines find() {
    std::vector<Seed> seeds = find_seeds();
    std::stable_sort(seeds.begin(), seeds.end(),
                     [](const Seed& a, const Seed& b) { return a.score > b.score; });
    MappedLines found;
    for (const double min_score : {options_.min_score, options_.min_joint_score}) {
      for (const Seed& seed : seeds) {
        if (surface_.is_taken(seed.side)) continue;
        const auto segment = grow(seed.line, min_score);
        if (!segment) continue;
        const GridFace face = segment->face();
        if (min_score < options_.min_score && !is_joint(face, found.faces)) continue;
        take(*segment, found.gaps);
        found.faces.push_back(face);
      }
    }
    const double variance = lengths_ > 0 ? squares_ / lengths_ - kRasterVariance : 0;
    found.inset = 0.5 + std::sqrt(std::max(variance, 0.0));
    for (GridFace& face : found.faces) {
      const Vec2 inset = found.inset * face.normal();
      face.from -= inset;
      face.to -= inset;
    }
    return found;
  }

 private:
  template <typename Visitor>
  void for_each_side(Visitor&& visit) const {
    const OccupancyGrid& grid = surface_.grid();
    for (std::int64_t row = 0; row < grid.rows(); ++row) {
      for (std::int64_t column = 0; column < grid.columns(); ++column) {
        surface_.for_each_side(column, row, [&](const Side& side) { visit(column, row, side); });
      }
    }
  }

  /// For each side the line through its neighbours that look the same way.
  std::vector<Seed> find_seeds() const {
    std::vector<Seed> seeds;
    for_each_side([&](std::int64_t column, std::int64_t row, const Side& side) {
      core::LineFit fit(side.middle);
      for (std::int64_t y = row - kSeedRadius; y <= row + kSeedRadius; ++y) {
        for (std::int64_t x = column - kSeedRadius; x <= column + kSeedRadius; ++x) {
          surface_.for_each_side(x, y, [&](const Side& other) {
            // Sides of the steps of an oblique wall look along either axis.
            if (other.normal.dot(side.normal) < 0) return;
            fit.add(other.middle.x(), other.middle.y(), 1);
          });
        }
      }
      if (fit.count() < 3) return;
      Vec2 direction = fit.line().direction();
      if (core::rotate_left(direction).dot(side.normal) < 0) direction = -direction;
      if (core::rotate_left(direction).dot(side.normal) < kMinFacing) return;
      const SurfaceLine line{side.middle, direction};
      seeds.push_back({side, line, extend(line, false).score + extend(line, true).score});
    });
    return seeds;
  }

  /// Both ends are near ends of faces across it.
  bool is_joint(const GridFace& face, const std::vector<GridFace>& faces) const {
    const double reach = kCornerRadius + 2 * options_.tolerance;
    const auto meets = [&](const Vec2& end) {
      return std::any_of(faces.begin(), faces.end(), [&](const GridFace& other) {
        return std::abs(core::cross(other.direction, face.direction)) > kMinFacing &&
               std::min((other.from - end).norm(), (other.to - end).norm()) < reach;
      });
    };
    return meets(face.from) && meets(face.to);
  }

  template <typename Visitor>
  void for_each_near(const SurfaceLine& line, const Slices& slices, std::int64_t slice,
                     double reach, Visitor&& visit) const {
    const Vec2 normal = line.normal();
    slices.for_each_cell(slice, reach + 1, [&](std::int64_t column, std::int64_t row) {
      surface_.for_each_side(column, row, [&](const Side& side) {
        if (side.normal.dot(normal) < kMinFacing) return;
        if (std::abs(line.height_of(side.middle)) <= reach) visit(side);
      });
    });
  }

  template <typename Visitor>
  void for_each_near(const SurfaceLine& line, const Interval& extent, double reach,
                     Visitor&& visit) const {
    const Slices slices(line);
    slices.for_each(extent,
                    [&](std::int64_t slice) { for_each_near(line, slices, slice, reach, visit); });
  }

  core::LineFit fit_sides(const SurfaceLine& line, const Interval& extent) const {
    core::LineFit fit(line.at);
    for_each_near(line, extent, options_.tolerance, [&](const Side& side) {
      fit.add(side.middle.x(), side.middle.y(), side.normal.dot(line.normal()));
    });
    return fit;
  }

  struct Reach {
    double end = 0;
    double score = 0;
  };
  enum class Slice { kOccupied, kUnknown, kFree };

  Slice look(const SurfaceLine& line, const Slices& slices, std::int64_t slice) const {
    bool is_hit = false;
    for_each_near(line, slices, slice, options_.tolerance, [&](const Side&) { is_hit = true; });
    if (is_hit) return Slice::kOccupied;
    const Vec2 behind = line.at + slices.along(slice) * line.direction - 0.75 * line.normal();
    return surface_.grid().at(behind) == Cell::kFree ? Slice::kFree : Slice::kUnknown;
  }

  /// Coordinate up to which the line is a wall, in one sense, with the best score on the way. The
  /// search ends where the score is so much lower that a gap would be too long.
  Reach extend(const SurfaceLine& line, bool ahead) const {
    const Slices slices(line);
    const std::int64_t step = ahead ? slices.sense() : -slices.sense();
    const double sign = ahead ? 1 : -1;
    double score = 0;
    double best = 0;
    double end = 0;
    double hole = 0;
    for (std::int64_t slice = slices.slice_of(0);; slice += step) {
      const Slice kind = look(line, slices, slice);
      score += kind == Slice::kOccupied ? 1 : kind == Slice::kFree ? kFreeScore : kUnknownScore;
      hole = kind == Slice::kFree ? hole + slices.step() : kind == Slice::kOccupied ? 0 : hole;
      if (kind == Slice::kOccupied && score >= best) {
        best = score;
        end = slices.along(slice) + sign * slices.step() / 2;
      }
      if (hole > options_.max_hole) break;
      if (score < best + kUnknownScore * options_.join_gap) break;
    }
    return {end, best};
  }

  std::optional<Segment> grow(SurfaceLine line, double min_score) const {
    Segment segment;
    for (int round = 0; round < kFitRounds; ++round) {
      const Reach back = extend(line, false);
      const Reach ahead = extend(line, true);
      segment.score = back.score + ahead.score;
      if (segment.score < min_score) return std::nullopt;
      segment.line = line;
      segment.extent = {back.end, ahead.end};
      if (round + 1 == kFitRounds) break;
      const core::LineFit fit = fit_sides(line, segment.extent);
      if (fit.count() < 3) return std::nullopt;
      const core::Line fitted = fit.line();
      const Vec2 direction = fitted.direction();
      line.direction = direction.dot(line.direction) > 0 ? direction : Vec2(-direction);
      // The search starts where a side is.
      line.at += (fitted.centroid - line.at).dot(fitted.normal) * fitted.normal;
    }
    return is_clear(segment) ? std::optional(segment) : std::nullopt;
  }

  /// Few cells before the line are occupied: it is no row of a cloud of dots.
  bool is_clear(const Segment& segment) const {
    const SurfaceLine& line = segment.line;
    const double reach = options_.tolerance;
    const SurfaceLine before{line.at + 2 * reach * line.normal(), line.direction};
    const Slices slices(before);
    int cells = 0;
    int occupied = 0;
    slices.for_each(segment.extent, [&](std::int64_t slice) {
      slices.for_each_cell(slice, reach, [&](std::int64_t column, std::int64_t row) {
        ++cells;
        if (surface_.grid().at(column, row) == Cell::kOccupied) ++occupied;
      });
    });
    return occupied < kMaxBefore * cells * segment.score / segment.extent.length();
  }

  void take(const Segment& segment, std::vector<JoinedGap>& gaps) {
    add_gaps(segment, gaps);
    std::vector<Side> sides;
    for_each_near(segment.line, segment.extent, options_.tolerance + 1,
                  [&](const Side& side) { sides.push_back(side); });
    for (const Side& side : sides) {
      surface_.take(side);
      const double height = segment.line.height_of(side.middle);
      if (std::abs(height) > options_.tolerance) continue;
      const double length = side.normal.dot(segment.line.normal());
      squares_ += length * height * height;
      lengths_ += length;
    }
  }

  void add_gaps(const Segment& segment, std::vector<JoinedGap>& gaps) const {
    const SurfaceLine& line = segment.line;
    const Slices slices(line);
    Interval gap{0, 0};
    slices.for_each(segment.extent, [&](std::int64_t slice) {
      const double half = slices.step() / 2;
      const double along = slices.along(slice);
      if (look(line, slices, slice) == Slice::kUnknown) {
        if (gap.length() == 0) gap.begin = along - half;
        gap.end = along + half;
      } else {
        if (gap.length() > options_.max_hole) {
          gaps.push_back({line.at + (gap.begin + gap.end) / 2 * line.direction, gap.length()});
        }
        gap = {0, 0};
      }
    });
  }

  Surface surface_;
  const LineSearchOptions& options_;
  double squares_ = 0;  ///< sum of the squared distances of sides from their lines, by length
  double lengths_ = 0;
};

}  // namespace

void draw_bands(const std::vector<GridFace>& faces, const Interval& heights, Cell kind,
                OccupancyGrid& grid) {
  for (const GridFace& face : faces) {
    const SurfaceLine line{face.from + (heights.begin + heights.end) / 2 * face.normal(),
                           face.direction};
    const Slices slices(line);
    slices.for_each({0, face.length()}, [&](std::int64_t slice) {
      slices.for_each_cell(slice, heights.length() / 2, [&](std::int64_t column, std::int64_t row) {
        if (grid.holds(column, row)) grid.set(column, row, kind);
      });
    });
  }
}

MappedLines find_lines(const OccupancyGrid& grid, const LineSearchOptions& options) {
  return LineSearch(grid, options).find();
}

}  // namespace cornerd::gridmap
