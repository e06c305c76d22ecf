// SPDX-License-Identifier: MIT
#include "gridmap/run_lines.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

namespace cornerd::gridmap {
namespace {

using core::Vec2;

/// Largest movement of a run's ends, in cells: the raster's error.
constexpr double kSquareMove = 0.4;
/// Largest distance of runs on one line, in cells.
constexpr double kSameLine = 0.6;
/// Largest overlap of continuations, in cells, from rounded corners.
constexpr double kOverlap = 1;
constexpr double kSampleStep = 0.5;

/// Angle of a run's direction from the nearest of the four axes of `frame_rad`.
double from_axis(const Run& run, double frame_rad) {
  return std::remainder(core::angle_of(run.direction) - frame_rad, core::kPi / 2);
}

double allowed_rotation(const Run& run) { return 2 * kSquareMove / std::max(run.extent, 1.0); }

/// The main direction: that of the longest run, refined by all that are square to it, weighted by
/// the information on their direction.
double main_direction(const std::vector<LinkedRun>& runs) {
  const auto longest = std::max_element(
      runs.begin(), runs.end(),
      [](const LinkedRun& a, const LinkedRun& b) { return a.run.extent < b.run.extent; });
  double frame_rad = std::remainder(core::angle_of(longest->run.direction), core::kPi / 2);
  constexpr int kRounds = 3;
  for (int round = 0; round < kRounds; ++round) {
    double sum = 0;
    double weights = 0;
    for (const LinkedRun& linked : runs) {
      const double rotation_rad = from_axis(linked.run, frame_rad);
      if (std::abs(rotation_rad) > allowed_rotation(linked.run)) continue;
      const double weight = std::pow(linked.run.extent, 3);
      sum += weight * rotation_rad;
      weights += weight;
    }
    if (weights > 0) frame_rad += sum / weights;
  }
  // Most pictures are aligned with the building.
  const double raster_rad = std::remainder(frame_rad, core::kPi / 2);
  return std::abs(raster_rad) < allowed_rotation(longest->run) / 4 ? frame_rad - raster_rad
                                                                   : frame_rad;
}

double gap_between(const Run& one, const LinkedRun& first, const LinkedRun& second) {
  return one.direction.dot(second.begin - first.end);
}

/// Cells behind the border between two runs.
struct Between {
  bool is_free = false;
  bool is_unknown = false;
};

Between look_between(const OccupancyGrid& grid, const FaceOptions& options, const LinkedRun& first,
                     double gap) {
  // The middle of the first row of cells behind the border.
  const Run& run = first.run;
  const Vec2 start = first.end - (run.height_of(first.end) + 0.5 - options.inset) * run.normal();
  Between between;
  for (double s = kSampleStep / 2; s < gap; s += kSampleStep) {
    const Cell cell = grid.at(start + s * run.direction);
    between.is_free = between.is_free || cell == Cell::kFree;
    between.is_unknown = between.is_unknown || cell == Cell::kUnknown;
  }
  return between;
}

struct Continuation {
  std::size_t first = 0;
  std::size_t second = 0;
  double gap = 0;
  bool is_unknown = false;
};

std::optional<Continuation> find_continuation(const OccupancyGrid& grid, const FaceOptions& options,
                                              const std::vector<LinkedRun>& runs, std::size_t i,
                                              std::size_t j) {
  const LinkedRun& first = runs[i];
  const LinkedRun& second = runs[j];
  const Run& longer = first.run.extent >= second.run.extent ? first.run : second.run;
  const Run& shorter = first.run.extent >= second.run.extent ? second.run : first.run;
  if (longer.direction.dot(shorter.direction) < 0.98) return std::nullopt;
  const double gap = gap_between(longer, first, second);
  if (gap < -kOverlap) return std::nullopt;
  const double half = shorter.extent / 2;
  if (std::abs(longer.height_of(shorter.at - half * shorter.direction)) > kSameLine ||
      std::abs(longer.height_of(shorter.at + half * shorter.direction)) > kSameLine) {
    return std::nullopt;
  }
  // A far run is of another wall.
  if (gap > options.join_gap && gap > 4 * longer.extent) return std::nullopt;
  const Between between = look_between(grid, options, first, gap);
  if (between.is_free || (between.is_unknown && gap > options.join_gap)) return std::nullopt;
  return Continuation{i, j, gap, between.is_unknown};
}

/// The runs of one line, from its first.
std::vector<std::size_t> chain_of(const std::vector<LinkedRun>& runs, std::size_t i) {
  while (runs[i].continues != kNoRun) i = runs[i].continues;
  std::vector<std::size_t> chain;
  for (; i != kNoRun; i = runs[i].continued_by) chain.push_back(i);
  return chain;
}

/// Gives the runs one line; keeps a common direction.
void share_line(std::vector<LinkedRun>& runs, const std::vector<std::size_t>& chain, double inset) {
  const LinkedRun& longest =
      runs[*std::max_element(chain.begin(), chain.end(), [&](std::size_t a, std::size_t b) {
        return runs[a].run.extent < runs[b].run.extent;
      })];
  core::LineFit fit(longest.run.at);
  bool parallel = true;
  for (const std::size_t i : chain) {
    fit.add(runs[i].run.fit);
    parallel = parallel && core::cross(longest.run.direction, runs[i].run.direction) == 0;
  }
  if (fit.count() < 2) return;
  const core::Line line = fit.line();
  Vec2 direction = longest.run.direction;
  if (!parallel)
    direction = line.direction().dot(direction) > 0 ? line.direction() : Vec2(-line.direction());
  const Vec2 at = line.centroid - inset * core::rotate_left(direction);
  for (const std::size_t i : chain) {
    runs[i].run.direction = direction;
    runs[i].run.at = at + direction.dot(runs[i].run.at - at) * direction;
  }
}

}  // namespace

void square_up(std::vector<LinkedRun>& runs) {
  if (runs.empty()) return;
  const double frame_rad = main_direction(runs);
  for (LinkedRun& linked : runs) {
    Run& run = linked.run;
    if (std::abs(from_axis(run, frame_rad)) > allowed_rotation(run)) continue;
    // All four axes from one, so that opposite ones are exactly opposite.
    const Vec2 axis = core::unit_vector(frame_rad);
    const double quarters = (core::angle_of(run.direction) - frame_rad) / (core::kPi / 2);
    const auto quarter = static_cast<int>(std::lround(quarters)) & 3;
    run.direction = quarter == 0   ? axis
                    : quarter == 1 ? core::rotate_left(axis)
                    : quarter == 2 ? Vec2(-axis)
                                   : Vec2(-core::rotate_left(axis));
  }
}

std::vector<JoinedGap> continue_runs(const OccupancyGrid& grid, const FaceOptions& options,
                                     std::vector<LinkedRun>& runs) {
  std::vector<Continuation> found;
  for (std::size_t i = 0; i < runs.size(); ++i) {
    for (std::size_t j = 0; j < runs.size(); ++j) {
      if (i == j) continue;
      if (const auto continuation = find_continuation(grid, options, runs, i, j)) {
        found.push_back(*continuation);
      }
    }
  }
  std::stable_sort(found.begin(), found.end(),
                   [](const Continuation& a, const Continuation& b) { return a.gap < b.gap; });
  std::vector<JoinedGap> gaps;
  for (const Continuation& c : found) {
    if (runs[c.first].continued_by != kNoRun || runs[c.second].continues != kNoRun) continue;
    if (chain_of(runs, c.first).front() == c.second) continue;
    runs[c.first].continued_by = c.second;
    runs[c.second].continues = c.first;
    if (c.is_unknown) gaps.push_back({(runs[c.first].end + runs[c.second].begin) / 2, c.gap});
  }
  for (std::size_t i = 0; i < runs.size(); ++i) {
    if (runs[i].continues != kNoRun || runs[i].continued_by == kNoRun) continue;
    share_line(runs, chain_of(runs, i), options.inset);
  }
  return gaps;
}

}  // namespace cornerd::gridmap
