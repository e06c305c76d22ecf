// SPDX-License-Identifier: MIT
#include "calibration/filtered_drive.hpp"

#include "core/odometry/fusion_filter.hpp"

namespace cornerd::calibration {
namespace {

/// What a known place is off by, the lidar's own errors included.
constexpr double kKnownSigma_m = 0.01;
constexpr double kKnownSigma_rad = 0.005;

core::Covariance3 known_covariance() {
  return Eigen::Vector3d(kKnownSigma_m * kKnownSigma_m, kKnownSigma_m * kKnownSigma_m,
                         kKnownSigma_rad * kKnownSigma_rad)
      .asDiagonal();
}

}  // namespace

FilteredDrive filter_drive(std::span<const core::MotionStep> steps,
                           std::span<const KnownPlace> places, const core::OdometryConfig& config,
                           core::TimeNs taught_until_ns) {
  FilteredDrive drive;
  core::FusionFilter filter(config);
  const core::Covariance3 doubt = known_covariance();
  std::size_t next = 0;
  while (next < places.size() && !steps.empty() && places[next].t_ns < steps.front().from_ns) {
    ++next;
  }
  bool begun = false;
  const auto arrive = [&](const KnownPlace& place) {
    if (!begun) {
      filter.set_pose(place.T_map_base, doubt);
      begun = true;
      return;
    }
    const core::Vec2 here = filter.pose().translation();
    drive.points.push_back(here);
    if (place.t_ns <= taught_until_ns) {
      // One that does not fit is taken all the same: the wheels slipped, the place is known.
      if (!filter.correct(place.T_map_base, doubt)) filter.set_pose(place.T_map_base, doubt);
      return;
    }
    drive.alone.end_m = (here - place.T_map_base.translation()).norm();
    drive.alone.mean_m += drive.alone.end_m;
    ++drive.alone.places;
  };
  for (const core::MotionStep& step : steps) {
    core::MotionStep rest = step;
    for (; next < places.size() && places[next].t_ns <= step.to_ns; ++next) {
      const core::TimeNs t_ns = places[next].t_ns;
      if (t_ns > rest.from_ns && t_ns < rest.to_ns) {
        const core::MotionStep before = rest.split(t_ns);
        if (begun) filter.predict(before);
      } else if (t_ns == rest.to_ns) {
        break;
      }
      arrive(places[next]);
    }
    if (begun) filter.predict(rest);
  }
  if (drive.alone.places > 0) drive.alone.mean_m /= static_cast<double>(drive.alone.places);
  drive.learned = filter.learned();
  drive.slips = filter.slips();
  return drive;
}

}  // namespace cornerd::calibration
