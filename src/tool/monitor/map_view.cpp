// SPDX-License-Identifier: MIT
#include "tool/monitor/map_view.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include "tool/monitor/dot_canvas.hpp"

namespace cornerd::tool {

namespace {

using core::Pose2;
using core::Vec2;

/// Steps of the lidar view's radius, so that the scale does not change with every scan.
constexpr std::array<double, 6> kViewRadii_m = {0.5, 1, 2, 4, 8, 12};
/// An outlier does not shrink the room. 5 % are more than an A1 has.
constexpr double kShareInView = 0.95;

/// Metres to dots, and to the cells of the frame.
class Projection {
 public:
  Projection(const DotCanvas& canvas, const Region& region, const Vec2& middle, const Vec2& size_m)
      : canvas_(canvas), region_(region), middle_(middle) {
    const double across = std::max(1.0, static_cast<double>(canvas.width()) - 1);
    const double down =
        std::max(1.0, static_cast<double>(canvas.height()) - 1) * canvas.dot_aspect();
    metres_per_dot_ = std::max({size_m.x() / across, size_m.y() / down, 1e-6});
  }

  Vec2 dot(const Vec2& point) const {
    const Vec2 off = (point - middle_) / metres_per_dot_;
    return {static_cast<double>(canvas_.width()) / 2 + off.x(),
            static_cast<double>(canvas_.height()) / 2 - off.y() / canvas_.dot_aspect()};
  }

  /// Draws a character if the point is inside.
  void put(Frame& frame, const Vec2& point, Cell cell) const {
    const Vec2 at = dot(point);
    const double column = std::floor(at.x() / dots_across());
    const double row = std::floor(at.y() / dots_down());
    if (!(column >= 0 && column < static_cast<double>(region_.columns))) return;
    if (!(row >= 0 && row < static_cast<double>(region_.rows))) return;
    frame.put(region_.column + static_cast<std::size_t>(column),
              region_.row + static_cast<std::size_t>(row), cell);
  }

  double metres_per_cell() const { return metres_per_dot_ * dots_across(); }

 private:
  double dots_across() const {
    return static_cast<double>(canvas_.width()) / static_cast<double>(region_.columns);
  }
  double dots_down() const {
    return static_cast<double>(canvas_.height()) / static_cast<double>(region_.rows);
  }

  const DotCanvas& canvas_;
  Region region_;
  Vec2 middle_;
  double metres_per_dot_ = 1;
};

char32_t arrow(double direction_rad, bool unicode) {
  constexpr std::u32string_view kArrows = U"→↗↑↖←↙↓↘";
  constexpr std::u32string_view kAsciiArrows = U">^<v";
  const std::u32string_view arrows = unicode ? kArrows : kAsciiArrows;
  const auto count = static_cast<double>(arrows.size());
  const double revolutions = direction_rad / (2 * core::kPi);
  const double index = std::round((revolutions - std::floor(revolutions)) * count);
  return arrows[static_cast<std::size_t>(index) % arrows.size()];
}

/// The smallest step that holds most of the scan's returns.
double view_radius_of(const ReceivedScan& received) {
  std::vector<double> ranges_m;
  for (const core::Sample& sample : received.scan.samples) {
    if (sample.range_m > 0) ranges_m.push_back(sample.range_m);
  }
  if (ranges_m.empty()) return kViewRadii_m.front();
  const auto index = static_cast<std::ptrdiff_t>(
      std::ceil(kShareInView * static_cast<double>(ranges_m.size())) - 1);
  std::nth_element(ranges_m.begin(), ranges_m.begin() + index, ranges_m.end());
  const double range_m = ranges_m[static_cast<std::size_t>(index)];
  const auto* const radius = std::lower_bound(kViewRadii_m.begin(), kViewRadii_m.end(), range_m);
  return radius == kViewRadii_m.end() ? range_m : *radius;
}

void draw_walls(DotCanvas& canvas, const Projection& projection, const core::WallMap& map) {
  for (const core::Face& face : map.faces()) {
    canvas.line(projection.dot(face.from), projection.dot(face.to), Style::kWall);
  }
}

void draw_returns(DotCanvas& canvas, const Projection& projection, const ReceivedScan& received,
                  const Pose2& T_view_lidar) {
  for (const core::Sample& sample : received.scan.samples) {
    if (sample.range_m <= 0) continue;
    const Vec2 point = core::unit_vector(sample.bearing_rad) * double{sample.range_m};
    const Vec2 at = projection.dot(T_view_lidar * point);
    canvas.dot(at.x(), at.y(), Style::kReturn);
  }
}

void draw_breakpoints(Frame& frame, const Projection& projection,
                      const message::ParsedBreakpoints& breakpoints, const Pose2& T_view_lidar) {
  for (const message::ParsedBreakpoint& point : breakpoints.points) {
    projection.put(frame, T_view_lidar * point.position,
                   {point.is_corner ? U'o' : U'x', Style::kMark});
  }
}

double draw_lidar_view(Frame& frame, const Region& region, const MonitorState& state,
                       const Scene& scene, const ViewChoice& choice) {
  if (!state.scan()) return 0;
  const double size_m = 2 * view_radius_of(*state.scan()) / std::exp2(choice.zoom);
  DotCanvas canvas(region.columns, region.rows, choice.unicode);
  const Pose2& T_base_lidar = scene.T_base_lidar;
  const Projection projection(canvas, region, T_base_lidar.translation(), {size_m, size_m});
  draw_returns(canvas, projection, *state.scan(), T_base_lidar);
  canvas.draw_on(frame, region.column, region.row);
  draw_breakpoints(frame, projection, state.breakpoints(), T_base_lidar);
  projection.put(frame, Vec2::Zero(), {arrow(0, choice.unicode), Style::kRobot});
  return projection.metres_per_cell();
}

double draw_map_view(Frame& frame, const Region& region, const MonitorState& state,
                     const Scene& scene, const ViewChoice& choice, core::TimeNs now_ns) {
  const core::WallMap& map = *scene.map;
  const std::optional<Pose2> robot = state.pose() ? state.pose()->T_map_base : std::nullopt;
  const Vec2 size_m = (map.upper_right() - map.lower_left()) / std::exp2(choice.zoom);
  const bool follows = choice.zoom > 0 && robot;
  const Vec2 middle =
      follows ? robot->translation() : Vec2((map.upper_right() + map.lower_left()) / 2);
  DotCanvas canvas(region.columns, region.rows, choice.unicode);
  const Projection projection(canvas, region, middle, size_m);

  draw_walls(canvas, projection, map);
  const bool is_placed = state.scan() && state.scan()->T_map_base;
  const Pose2 T_map_lidar =
      is_placed ? *state.scan()->T_map_base * scene.T_base_lidar : scene.T_base_lidar;
  if (is_placed) draw_returns(canvas, projection, *state.scan(), T_map_lidar);
  canvas.draw_on(frame, region.column, region.row);
  if (is_placed) draw_breakpoints(frame, projection, state.breakpoints(), T_map_lidar);
  if (state.pose()) {
    for (const core::Alternative& place : state.pose()->alternatives) {
      projection.put(frame, place.T_map_base.translation(), {U'?', Style::kWarning});
    }
  }
  if (robot) {
    projection.put(frame, robot->translation(),
                   {arrow(robot->theta_rad, choice.unicode),
                    state.is_pose_stale(now_ns) ? Style::kDim : Style::kRobot});
  }
  return projection.metres_per_cell();
}

}  // namespace

double draw_map(Frame& frame, const Region& region, const MonitorState& state, const Scene& scene,
                const ViewChoice& choice, core::TimeNs now_ns) {
  if (region.columns == 0 || region.rows == 0) return 0;
  if (scene.map == nullptr || choice.lidar_view) {
    return draw_lidar_view(frame, region, state, scene, choice);
  }
  return draw_map_view(frame, region, state, scene, choice, now_ns);
}

}  // namespace cornerd::tool
