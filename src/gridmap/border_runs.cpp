// SPDX-License-Identifier: MIT
#include "gridmap/border_runs.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <queue>
#include <utility>

namespace cornerd::gridmap {
namespace {

using core::Vec2;

/// A run of this length is fitted without its first and last sides, which belong to the corners.
constexpr std::size_t kTrimmedFrom = 8;
/// A border of noise has few runs of this length, from first to last side, within the raster's
/// error.
constexpr double kStraight = 4;
constexpr double kRasterError = 0.75;
constexpr std::size_t kTrimmedSides = 1;
/// The direction of a shorter run is that of the raster.
constexpr double kUndirected = 5;
/// A shorter run between two that meet beside it is a corner cut off by the raster.
constexpr double kChamfer = 2.9;
/// Two longer runs in opposite directions are the two faces of a thin wall.
constexpr double kBackwards = 1.5;

Vec2 displacement(const Border& border, const Run& run) {
  return border.points[run.end].place() - border.points[run.begin].place();
}

double largest_distance(const Border& border, const Run& run) {
  double largest = 0;
  for (std::size_t i = run.begin; i < run.end; ++i) {
    largest = std::max(largest, std::abs(run.height_of(border.middle(i))));
  }
  return largest;
}

/// Begins a closed border at the point farthest from its first, which is a corner.
void turn_to_corner(Border& border) {
  if (!border.closed) return;
  border.points.pop_back();
  const auto far = std::max_element(border.points.begin(), border.points.end(),
                                    [&](const Border::Point& a, const Border::Point& b) {
                                      const Vec2 origin = border.points.front().place();
                                      return (a.place() - origin).squaredNorm() <
                                             (b.place() - origin).squaredNorm();
                                    });
  std::rotate(border.points.begin(), far, border.points.end());
  border.points.push_back(border.points.front());
}

/// Iterative end-point fit. Without recursion: a border may be very long.
std::vector<Run> split(const Border& border, double tolerance) {
  std::vector<Run> runs;
  std::vector<std::pair<std::size_t, std::size_t>> open = {{0, border.size()}};
  while (!open.empty()) {
    const auto [begin, end] = open.back();
    open.pop_back();
    const Vec2 first = border.middle(begin);
    const Vec2 chord = border.middle(end - 1) - first;
    const double length = chord.norm();
    double farthest = 0;
    std::size_t cut = begin;
    for (std::size_t i = begin + 1; i + 1 < end; ++i) {
      const Vec2 direction = border.middle(i) - first;
      const double distance =
          length > 1e-9 ? std::abs(core::cross(chord, direction)) / length : direction.norm();
      if (distance > farthest) {
        farthest = distance;
        cut = i;
      }
    }
    if (farthest > tolerance) {
      open.emplace_back(cut, end);
      open.emplace_back(begin, cut);
      continue;
    }
    Run run;
    run.begin = begin;
    run.end = end;
    fit_run(border, run);
    runs.push_back(run);
  }
  return runs;
}

Run joined(const Border& border, const Run& one, const Run& next) {
  Run both;
  both.begin = one.begin;
  both.end = next.end;
  fit_run(border, both);
  return both;
}

/// Largest distance from the line of both runs; infinite where they are two faces of a thin wall.
double cost_of_joining(const Border& border, const Run& one, const Run& next) {
  const Vec2 a = displacement(border, one);
  const Vec2 b = displacement(border, next);
  if (a.norm() > kBackwards && b.norm() > kBackwards && a.dot(b) < 0) {
    return std::numeric_limits<double>::infinity();
  }
  return largest_distance(border, joined(border, one, next));
}

/// Joins adjacent runs, the most collinear first. A heap and links, since a rough border has as
/// many runs as steps.
void join(const Border& border, double tolerance, std::vector<Run>& runs) {
  struct Join {
    double cost;
    std::size_t first;
    std::size_t first_end;  ///< ends of both runs at the time; the entry is stale if one has grown
    std::size_t second_end;
    bool operator<(const Join& other) const { return cost > other.cost; }
  };
  std::priority_queue<Join> joins;
  std::vector<std::size_t> next(runs.size());
  std::vector<std::size_t> previous(runs.size());
  const auto offer = [&](std::size_t i) {
    const std::size_t j = next[i];
    if (j >= runs.size()) return;
    const double cost = cost_of_joining(border, runs[i], runs[j]);
    if (cost <= tolerance) joins.push({cost, i, runs[i].end, runs[j].end});
  };
  for (std::size_t i = 0; i < runs.size(); ++i) {
    next[i] = i + 1;
    previous[i] = i - 1;  // of the first: beyond all
  }
  for (std::size_t i = 0; i < runs.size(); ++i) offer(i);
  while (!joins.empty()) {
    const Join best = joins.top();
    joins.pop();
    const std::size_t i = best.first;
    const std::size_t j = next[i];
    if (runs[i].end != best.first_end || j >= runs.size() || runs[j].end != best.second_end) {
      continue;
    }
    runs[i] = joined(border, runs[i], runs[j]);
    runs[j].end = runs[j].begin;  // empty: gone
    next[i] = next[j];
    if (next[i] < runs.size()) previous[next[i]] = i;
    offer(i);
    if (previous[i] < runs.size()) offer(previous[i]);
  }
  std::erase_if(runs, [](const Run& run) { return run.size() == 0; });
}

/// Moves the cut between two runs to the place with the least squared distances.
void move_cut(const Border& border, Run& one, Run& next) {
  const std::size_t low = one.begin + one.size() / 2;
  const std::size_t high = next.begin + (next.size() + 1) / 2;
  const auto squared = [&](const Run& run, std::size_t i) {
    const double height = run.height_of(border.middle(i));
    return height * height;
  };
  double change = 0;  // of the sum of squares, from the cut at `low`
  double best = 0;
  std::size_t cut = std::max(low, one.begin + 1);
  for (std::size_t i = low; i < high; ++i) {
    change += squared(one, i) - squared(next, i);
    if (change < best && i + 1 < next.end) {
      best = change;
      cut = i + 1;
    }
  }
  one.end = next.begin = cut;
}

void move_cuts(const Border& border, std::vector<Run>& runs) {
  constexpr int kRounds = 3;
  for (int round = 0; round < kRounds; ++round) {
    for (std::size_t i = 0; i + 1 < runs.size(); ++i) move_cut(border, runs[i], runs[i + 1]);
    for (Run& run : runs) fit_run(border, run);
  }
}

/// Neighbour of a run of a closed border; of an open one: itself at its ends.
std::size_t neighbour(const Border& border, std::size_t count, std::size_t i, bool next) {
  if (next) return i + 1 < count ? i + 1 : border.closed ? 0 : i;
  return i > 0 ? i - 1 : border.closed ? count - 1 : i;
}

bool is_chamfer(const Border& border, const Run& before, const Run& run, const Run& after,
                double longest) {
  if (run.extent > longest || before.extent < run.extent || after.extent < run.extent) return false;
  const double sine = core::cross(before.direction, after.direction);
  if (std::abs(sine) < 0.5) return false;
  const double along = core::cross(after.at - before.at, after.direction) / sine;
  const Vec2 corner = before.at + along * before.direction;
  const Vec2 middle = (border.points[run.begin].place() + border.points[run.end].place()) / 2;
  return (corner - middle).norm() < longest;
}

/// Removes cut-off corners: their neighbours meet, with unchanged lines.
void sharpen_corners(const Border& border, double tolerance, std::vector<Run>& runs) {
  const double longest = std::max(kChamfer, 2 * tolerance);
  for (std::size_t i = 1; i + 1 < runs.size();) {
    if (!is_chamfer(border, runs[i - 1], runs[i], runs[i + 1], longest)) {
      ++i;
      continue;
    }
    const std::size_t cut = runs[i].begin + runs[i].size() / 2;
    runs[i - 1].end = runs[i + 1].begin = cut;
    runs.erase(runs.begin() + static_cast<std::ptrdiff_t>(i));
  }
}

/// Makes short runs square or parallel to the longer one of their neighbours.
void direct_short_runs(const Border& border, std::vector<Run>& runs) {
  const double square = std::sin(core::radians(30));
  for (std::size_t i = 0; i < runs.size(); ++i) {
    Run& run = runs[i];
    if (run.extent >= kUndirected) continue;
    const Run& before = runs[neighbour(border, runs.size(), i, false)];
    const Run& after = runs[neighbour(border, runs.size(), i, true)];
    const Run& longer = before.extent > after.extent ? before : after;
    if (longer.extent < kUndirected) continue;
    const double sine = core::cross(longer.direction, run.direction);
    const double cosine = longer.direction.dot(run.direction);
    if (std::abs(cosine) < square) {
      run.direction = sine > 0 ? core::rotate_left(longer.direction)
                               : Vec2(-core::rotate_left(longer.direction));
    } else if (std::abs(sine) < square) {
      run.direction = cosine > 0 ? longer.direction : Vec2(-longer.direction);
    }
  }
}

}  // namespace

void fit_run(const Border& border, Run& run) {
  const std::size_t trim = run.size() >= kTrimmedFrom ? kTrimmedSides : 0;
  const Vec2 first = border.middle(run.begin);
  run.fit = core::LineFit(first);
  for (std::size_t i = run.begin + trim; i < run.end - trim; ++i) {
    const Vec2 middle = border.middle(i);
    run.fit.add(middle.x(), middle.y(), 1);
  }
  const Vec2 direction = displacement(border, run);
  run.extent = (border.middle(run.end - 1) - first).norm();
  if (run.fit.count() < 2) {
    run.at = first;
    run.direction = direction.normalized();
    return;
  }
  const core::Line line = run.fit.line();
  run.at = line.centroid;
  run.direction = line.direction().dot(direction) >= 0 ? line.direction() : Vec2(-line.direction());
}

std::vector<Run> straight_runs(Border& border, double tolerance) {
  turn_to_corner(border);
  std::vector<Run> runs = split(border, tolerance);
  join(border, tolerance, runs);
  move_cuts(border, runs);
  sharpen_corners(border, tolerance, runs);
  direct_short_runs(border, runs);
  return runs;
}

Straightness straightness(const OccupancyGrid& grid) {
  std::size_t all = 0;
  std::size_t in_long = 0;
  std::size_t straight = 0;
  for (Border& border : trace_borders(grid)) {
    all += border.size();
    if (static_cast<double>(border.size()) < 4 * (kStraight + 1)) continue;
    in_long += border.size();
    for (const Run& run : straight_runs(border, kRasterError)) {
      if (run.extent >= kStraight) straight += run.size();
    }
  }
  const auto share_of = [&](std::size_t whole) {
    return whole == 0 ? 1 : static_cast<double>(straight) / static_cast<double>(whole);
  };
  return {share_of(in_long), share_of(all)};
}

}  // namespace cornerd::gridmap
