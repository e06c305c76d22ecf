// SPDX-License-Identifier: MIT
#include "calibration/drive_reckoning.hpp"

#include <cstddef>
#include <functional>

#include "calibration/odometry_fit.hpp"
#include "core/odometry/motion_factor.hpp"
#include "core/odometry/motion_filter.hpp"

namespace cornerd::calibration {
namespace {

using core::OdometryIncrement;

/// Integrates the increments and compares at each known pose. `prepare` gets whole increments,
/// `motion` their parts between two poses.
template <typename Prepare, typename Motion>
DriveError for_each_known_pose(std::span<const OdometryIncrement> steps,
                               std::span<const KnownPose> places, DrivePoints* points,
                               const Prepare& prepare, const Motion& motion) {
  DriveError error;
  std::size_t next = 0;
  while (next < places.size() && !steps.empty() && places[next].t_ns < steps.front().from_ns) {
    ++next;
  }
  if (next == places.size()) return error;
  core::Pose2 T_map_base = places[next].T_map_base;
  core::TimeNs now_ns = places[next].t_ns;
  ++next;
  for (const OdometryIncrement& step : steps) {
    if (step.to_ns <= now_ns) continue;
    OdometryIncrement rest = prepare(step);
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

/// Sigmas of a known pose.
constexpr double kKnownSigma_m = 0.01;
constexpr double kKnownSigma_rad = 0.005;

core::Covariance3 known_covariance() {
  return Eigen::Vector3d(kKnownSigma_m * kKnownSigma_m, kKnownSigma_m * kKnownSigma_m,
                         kKnownSigma_rad * kKnownSigma_rad)
      .asDiagonal();
}

}  // namespace

DriveError reckon(std::span<const OdometryIncrement> steps, std::span<const KnownPose> places,
                  const core::DriveGeometry& geometry, const DeadReckoningConfig& config,
                  DrivePoints* points) {
  // The dead band applies to whole increments: their parts would stay under it.
  return for_each_known_pose(
      steps, places, points,
      [&](const OdometryIncrement& step) { return by_wheels_alone(step, geometry, config); },
      [&](const OdometryIncrement& alone) {
        return core::arc(alone.translation_m(), (alone.right_m - alone.left_m) / geometry.track_m);
      });
}

DriveError reckon(std::span<const OdometryIncrement> steps, std::span<const KnownPose> places,
                  const core::DriveGeometry& geometry, const core::OdometryParameters& learned,
                  DrivePoints* points) {
  return for_each_known_pose(at_true_times(steps, learned.delay_s), places, points, std::identity(),
                             [&](const OdometryIncrement& step) {
                               return core::CalibratedIncrement(step, geometry, learned).motion();
                             });
}

FilteredDrive filter_drive(std::span<const core::OdometryIncrement> steps,
                           std::span<const KnownPose> places, const core::OdometryConfig& config,
                           core::TimeNs corrected_until_ns) {
  FilteredDrive drive;
  core::MotionFilter filter(config);
  const core::Covariance3 covariance = known_covariance();
  std::size_t next = 0;
  while (next < places.size() && !steps.empty() && places[next].t_ns < steps.front().from_ns) {
    ++next;
  }
  bool begun = false;
  const auto arrive = [&](const KnownPose& place) {
    filter.advance();
    if (!begun) {
      filter.set_pose(place.T_map_base, covariance, {});
      begun = true;
      return;
    }
    const core::Vec2 here = filter.pose().translation();
    drive.points.push_back(here);
    if (place.t_ns <= corrected_until_ns) {
      // A pose that fails the gate resets the filter: the wheels slipped.
      if (!filter.correct(place.T_map_base, covariance, {})) {
        filter.set_pose(place.T_map_base, covariance, {});
      }
      return;
    }
    drive.alone.end_m = (here - place.T_map_base.translation()).norm();
    drive.alone.mean_m += drive.alone.end_m;
    ++drive.alone.places;
  };
  for (const core::OdometryIncrement& step : steps) {
    core::OdometryIncrement rest = step;
    for (; next < places.size() && places[next].t_ns <= step.to_ns; ++next) {
      const core::TimeNs t_ns = places[next].t_ns;
      if (t_ns > rest.from_ns && t_ns < rest.to_ns) {
        const core::OdometryIncrement before = rest.split(t_ns);
        if (begun) filter.add(before);
      } else if (t_ns == rest.to_ns) {
        break;
      }
      arrive(places[next]);
    }
    if (begun) filter.add(rest);
  }
  if (drive.alone.places > 0) drive.alone.mean_m /= static_cast<double>(drive.alone.places);
  drive.learned = filter.parameters();
  drive.slips = filter.slips();
  return drive;
}

}  // namespace cornerd::calibration
