// SPDX-License-Identifier: MIT
#include "mapped_scene.hpp"

#include <cmath>

#include "core/map/wall_map.hpp"

namespace cornerd::survey {

LineObservation observation_of(const core::Vec2& from, const core::Vec2& to,
                               const core::Pose2& T_map_lidar) {
  const core::Pose2 T_lidar_map = T_map_lidar.inverse();
  const core::Vec2 first = T_lidar_map * from;
  const core::Vec2 last = T_lidar_map * to;
  LineObservation seen;
  seen.normal_rad = core::angle_of(core::rotate_left(last - first));
  seen.centroid = (first + last) / 2;
  seen.begin_m = -(last - first).norm() / 2;
  seen.end_m = -seen.begin_m;
  seen.sigma_angle_rad = 0.002;
  seen.sigma_offset_m = 0.001;
  seen.support = 50;
  return seen;
}

LineLandmark face_between(const core::Vec2& from, const core::Vec2& to) {
  LineLandmark face(observation_of(from, to, {}), {}, 0);
  face.observations = 20;
  return face;
}

MappedDrive mapped_drive(std::span<const std::pair<core::Vec2, core::Vec2>> walls,
                         std::span<const core::Pose2> poses) {
  MappedDrive drive;
  for (const auto& [from, to] : walls) drive.faces.push_back(face_between(from, to));
  drive.first_point.push_back(0);
  for (std::size_t scan = 0; scan < poses.size(); ++scan) {
    drive.T_map_lidar.push_back(poses[scan]);
    OdometryEdge link;
    if (scan > 0) link.T_before_now = poses[scan - 1].inverse() * poses[scan];
    link.covariance *= 1e-4;
    drive.odometry_edges.push_back(link);
    for (std::uint32_t i = 0; i < drive.faces.size(); ++i) {
      if (drive.faces[i].height_of(poses[scan].translation()) <= 0) continue;
      drive.observations.push_back({static_cast<std::uint32_t>(scan), i,
                                    observation_of(walls[i].first, walls[i].second, poses[scan])});
    }
    drive.first_point.push_back(0);
  }
  return drive;
}

void add_returns(MappedDrive& drive) {
  core::FloorPlan plan;
  for (const LineLandmark& face : drive.faces) plan.walls.push_back({face.first(), face.last(), 0});
  const core::WallMap map(plan);
  drive.points.clear();
  drive.first_point.assign(1, 0);
  constexpr int kRays = 720;
  for (const core::Pose2& pose : drive.T_map_lidar) {
    for (int i = 0; i < kRays; ++i) {
      const double bearing_rad = -core::kPi + (i + 0.5) * core::kTwoPi / kRays;
      const double range_m = map.range_along(pose.translation(), pose.theta_rad + bearing_rad, 12);
      if (range_m == 0) continue;
      drive.points.push_back({static_cast<float>(bearing_rad), static_cast<float>(range_m)});
    }
    drive.first_point.push_back(drive.points.size());
  }
}

}  // namespace cornerd::survey
