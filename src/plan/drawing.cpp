// SPDX-License-Identifier: MIT
#include "plan/drawing.hpp"

#include <algorithm>
#include <cmath>

namespace cornerd::plan {

namespace {

/// A drawing in micrometres of a building of a kilometre.
constexpr double kMaxCoordinate = 1e9;

}  // namespace

void add_line(Drawing& drawing, const core::Vec2& from, const core::Vec2& to) {
  const double largest = std::max(from.lpNorm<Eigen::Infinity>(), to.lpNorm<Eigen::Infinity>());
  if (!from.allFinite() || !to.allFinite() || largest > kMaxCoordinate) {
    throw PlanError("has a coordinate beyond 1e9 units: remove that line");
  }
  if (drawing.lines.size() >= kMaxLines) {
    throw PlanError("has more than " + std::to_string(kMaxLines) +
                    " lines: keep only the layers with walls (--layer)");
  }
  drawing.lines.push_back({from, to});
}

void check_layers(const Drawing& drawing, const LayerChoice& layers) {
  constexpr std::size_t kMaxNames = 20;
  for (const std::string& layer : layers) {
    if (drawing.layers.contains(layer)) continue;
    std::string names;
    std::size_t count = 0;
    for (const auto& [name, lines] : drawing.layers) {
      if (++count > kMaxNames) break;
      names += (names.empty() ? "" : ", ") + name;
    }
    if (count > kMaxNames) names += ", ...";
    throw PlanError("has no layer \"" + layer + "\"" +
                    (names.empty() ? ", nor any other: omit --layer" : "; its layers: " + names));
  }
}

std::vector<core::Vec2> arc_points(const core::Vec2& centre, double radius, double begin_rad,
                                   double sweep_rad) {
  const double chords = std::clamp(std::ceil(std::abs(sweep_rad) / kChord_rad - 1e-9), 1.0, 36.0);
  std::vector<core::Vec2> points;
  for (double i = 1; i <= chords; ++i) {
    points.push_back(centre + radius * core::unit_vector(begin_rad + sweep_rad * i / chords));
  }
  return points;
}

}  // namespace cornerd::plan
