// SPDX-License-Identifier: MIT
#include "survey/line_landmark.hpp"

#include <algorithm>

#include "core/geometry/linear_solve.hpp"

namespace cornerd::survey {

PlacedObservation::PlacedObservation(const LineObservation& seen, const core::Pose2& T_map_lidar)
    : normal_rad(core::normalize_angle(seen.normal_rad + T_map_lidar.theta_rad)),
      centroid(T_map_lidar * seen.centroid) {
  const core::Vec2 direction = along(core::unit_vector(normal_rad));
  first = centroid + seen.begin_m * direction;
  last = centroid + seen.end_m * direction;
}

LineLandmark::LineLandmark(const LineObservation& seen, const core::Pose2& T_map_lidar,
                           std::size_t scan)
    : observations(1),
      first_scan(scan),
      last_scan(scan),
      anchor_(T_map_lidar * seen.centroid),
      normal_rad_(core::normalize_angle(seen.normal_rad + T_map_lidar.theta_rad)),
      normal_(core::unit_vector(normal_rad_)),
      begin_m_(seen.begin_m),
      end_m_(seen.end_m) {
  covariance_ << seen.sigma_angle_rad * seen.sigma_angle_rad, 0, 0,
      seen.sigma_offset_m * seen.sigma_offset_m;
}

void LineLandmark::set_line(double normal_rad, double offset_m) {
  normal_rad_ = core::normalize_angle(normal_rad);
  normal_ = core::unit_vector(normal_rad_);
  offset_m_ = offset_m;
}

void LineLandmark::extend(const core::Vec2& point) {
  const double along_m = along_of(point);
  begin_m_ = std::min(begin_m_, along_m);
  end_m_ = std::max(end_m_, along_m);
}

void LineLandmark::update(const LineObservation& seen, const core::Pose2& T_map_lidar,
                          std::size_t scan) {
  const PlacedObservation placed(seen, T_map_lidar);
  const double along_m = along_of(placed.centroid);
  // d(offset at along) = along * d(angle) + d(offset at the anchor)
  Eigen::Matrix2d design;
  design << 1, 0, along_m, 1;
  const Eigen::Vector2d innovation(core::angle_between(normal_rad_, placed.normal_rad),
                                   height_of(placed.centroid));
  const Eigen::Vector2d variance(seen.sigma_angle_rad * seen.sigma_angle_rad,
                                 seen.sigma_offset_m * seen.sigma_offset_m);
  Eigen::Matrix2d innovation_covariance = design * covariance_ * design.transpose();
  innovation_covariance.diagonal() += variance;
  const Eigen::Matrix2d gain =
      covariance_ * design.transpose() * core::inverse(innovation_covariance);
  const Eigen::Vector2d correction = gain * innovation;
  covariance_ = (Eigen::Matrix2d::Identity() - gain * design) * covariance_;
  covariance_ = (covariance_ + covariance_.transpose().eval()) / 2;
  set_line(normal_rad_ + correction[0], offset_m_ + correction[1]);
  see(seen, T_map_lidar, scan);
}

void LineLandmark::see(const LineObservation& seen, const core::Pose2& T_map_lidar,
                       std::size_t scan) {
  const PlacedObservation placed(seen, T_map_lidar);
  extend(placed.first);
  extend(placed.last);
  ++observations;
  last_scan = scan;
}

}  // namespace cornerd::survey
