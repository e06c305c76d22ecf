// SPDX-License-Identifier: MIT
#include "bench/localization/cramer_rao.hpp"

#include <cmath>

#include "core/geometry/linear_solve.hpp"

namespace cornerd::bench {
namespace {

/// Returns farther from the wall are outliers, in standard deviations.
constexpr double kOutlierSigmas = 6;

}  // namespace

core::Covariance3 CramerRao::bound(const core::WallMap& map, const core::Pose2& T_map_lidar,
                                   const core::PolarScan& scan) {
  Eigen::Matrix3d information = Eigen::Matrix3d::Zero();
  faces_.assign(map.faces().size(), {});
  const auto hits = prediction_.cast(map, T_map_lidar, scan.points());
  for (std::size_t i = 0; i < hits.size(); ++i) {
    if (hits[i].face == core::PredictedHit::kNone) continue;
    const core::Face& face = map.faces()[hits[i].face];
    const double range_m = hits[i].range_m;
    const double angle_rad = T_map_lidar.theta_rad + scan[i].bearing_rad;
    const core::Vec2 ray(std::cos(angle_rad), std::sin(angle_rad));
    const double sine = std::abs(face.normal.dot(ray));
    const double variance_m2 = noise_.variance_across_m2(range_m, sine);
    const double across_m = (scan[i].range_m - range_m) * sine;
    const double most_m2 = kOutlierSigmas * kOutlierSigmas * (variance_m2 + map_variance_m2_);
    if (across_m * across_m > most_m2) continue;
    const core::Vec2 arm = range_m * ray;
    const Eigen::Vector3d jacobian(face.normal.x(), face.normal.y(),
                                   face.normal.y() * arm.x() - face.normal.x() * arm.y());
    information += jacobian * jacobian.transpose() / variance_m2;
    faces_[hits[i].face].information += 1 / variance_m2;
    faces_[hits[i].face].gradient += jacobian / variance_m2;
  }
  for (const FaceSums& face : faces_) {
    information -= face.gradient * face.gradient.transpose() * map_variance_m2_ /
                   (1 + map_variance_m2_ * face.information);
  }
  const core::Covariance3 bound = core::inverse(information);
  return bound.allFinite() ? bound : core::Covariance3::Zero();
}

}  // namespace cornerd::bench
