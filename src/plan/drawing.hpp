// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <set>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "core/geometry/pose2.hpp"

namespace cornerd::plan {

/// A drawing that cannot be read. what() is the reason, and what to do.
class PlanError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

struct DrawnLine {
  core::Vec2 from = core::Vec2::Zero();
  core::Vec2 to = core::Vec2::Zero();
};

/// The straight lines of a drawing, curves as chords. x to the right, y up, in the drawing's units.
struct Drawing {
  std::vector<DrawnLine> lines;
  std::optional<double> metres_per_unit;       ///< nullopt: the drawing does not say
  std::map<std::string, std::size_t> layers;   ///< all of the drawing, with their lines
  std::map<std::string, std::size_t> ignored;  ///< kinds of elements that are no walls, or unknown
};

/// Names of layers to read; empty: all.
using LayerChoice = std::set<std::string>;

/// More are no plan of walls, or a file made to exhaust memory.
inline constexpr std::size_t kMaxLines = 200'000;
/// Chords of curves: of a circle, and of a Bezier curve.
inline constexpr double kChord_rad = core::radians(10);
inline constexpr int kChordsOfACurve = 12;

/// Adds a line; throws PlanError where it is not finite or one too many.
void add_line(Drawing& drawing, const core::Vec2& from, const core::Vec2& to);

/// Throws PlanError with the names that exist where a chosen one does not.
void check_layers(const Drawing& drawing, const LayerChoice& layers);

/// Points of an arc from `begin_rad` through `sweep_rad`, without its first point.
std::vector<core::Vec2> arc_points(const core::Vec2& centre, double radius, double begin_rad,
                                   double sweep_rad);

}  // namespace cornerd::plan
