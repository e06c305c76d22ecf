// SPDX-License-Identifier: MIT
#include <cstddef>
#include <functional>

#include "calibration/odometry_fit.hpp"
#include "core/odometry/learned_motion.hpp"

namespace cornerd::calibration {
namespace {

using core::MotionStep;

/// Walks through the steps, and looks at each known place where the robot has got to. `prepare` has
/// whole steps, `motion` those parts of them that lie between two places.
template <typename Prepare, typename Motion>
DriveError walk(std::span<const MotionStep> steps, std::span<const KnownPlace> places,
                DrivePoints* points, const Prepare& prepare, const Motion& motion) {
  DriveError error;
  std::size_t next = 0;
  while (next < places.size() && !steps.empty() && places[next].t_ns < steps.front().from_ns) {
    ++next;
  }
  if (next == places.size()) return error;
  core::Pose2 T_map_base = places[next].T_map_base;
  core::TimeNs now_ns = places[next].t_ns;
  ++next;
  for (const MotionStep& step : steps) {
    if (step.to_ns <= now_ns) continue;
    MotionStep rest = prepare(step);
    if (rest.from_ns < now_ns) rest.split(now_ns);
    while (next < places.size() && places[next].t_ns <= rest.to_ns) {
      if (places[next].t_ns > rest.from_ns && places[next].t_ns < rest.to_ns) {
        T_map_base = T_map_base * motion(rest.split(places[next].t_ns));
      } else if (places[next].t_ns == rest.to_ns) {
        break;
      }
      error.end_m = (T_map_base.translation() - places[next].T_map_base.translation()).norm();
      error.mean_m += error.end_m;
      if (points != nullptr) points->push_back(T_map_base.translation());
      ++error.places;
      ++next;
    }
    T_map_base = T_map_base * motion(rest);
    now_ns = rest.to_ns;
  }
  if (error.places > 0) error.mean_m /= static_cast<double>(error.places);
  return error;
}

}  // namespace

DriveError reckon(std::span<const MotionStep> steps, std::span<const KnownPlace> places,
                  const core::DriveGeometry& geometry, const core::DeadReckoningConfig& config,
                  DrivePoints* points) {
  // A dead band is for whole steps: parts of them would stay under it.
  return walk(
      steps, places, points,
      [&](const MotionStep& step) { return core::by_wheels_alone(step, geometry, config); },
      [&](const MotionStep& alone) {
        return core::arc(alone.way_m(), (alone.right_m - alone.left_m) / geometry.track_m);
      });
}

DriveError reckon(std::span<const MotionStep> steps, std::span<const KnownPlace> places,
                  const core::DriveGeometry& geometry, const core::LearnedOdometry& learned,
                  DrivePoints* points) {
  return walk(at_true_times(steps, learned.delay_s), places, points, std::identity(),
              [&](const MotionStep& step) {
                const core::LearnedMotion moved = core::learned_motion(step, geometry, learned);
                return core::arc(moved.way_m, moved.rotation_rad);
              });
}

}  // namespace cornerd::calibration
