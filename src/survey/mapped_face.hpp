// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>

#include <Eigen/Core>

#include "core/geometry/pose2.hpp"
#include "survey/sighting.hpp"

namespace cornerd::survey {

inline constexpr std::uint32_t kNoFace = 0xffffffff;

/// A sighting at the pose that it was seen from.
struct PlacedSighting {
  PlacedSighting(const Sighting& seen, const core::Pose2& T_map_lidar);
  double normal_rad;
  core::Vec2 centroid;
  core::Vec2 first;  ///< ends of what was seen
  core::Vec2 last;
};

/// One side of a wall in the map: the line normal.dot(p - anchor) = offset_m, of which the part
/// from begin_m to end_m, counted along it from the anchor, was seen.
class MappedFace {
 public:
  MappedFace(const Sighting& seen, const core::Pose2& T_map_lidar, std::size_t scan);

  double normal_rad() const { return normal_rad_; }
  const core::Vec2& normal() const { return normal_; }
  core::Vec2 direction() const { return along(normal_); }
  const core::Vec2& anchor() const { return anchor_; }
  double offset_m() const { return offset_m_; }
  double begin_m() const { return begin_m_; }
  double end_m() const { return end_m_; }
  double length_m() const { return end_m_ - begin_m_; }
  /// Of (angle, offset at the anchor).
  const Eigen::Matrix2d& covariance() const { return covariance_; }

  /// The point of the line that is `along_m` from the anchor.
  core::Vec2 at(double along_m) const {
    return anchor_ + offset_m_ * normal_ + along_m * direction();
  }
  core::Vec2 first() const { return at(begin_m_); }
  core::Vec2 last() const { return at(end_m_); }
  /// Place of a point along the line, and its distance into the free space.
  double along_of(const core::Vec2& point) const { return direction().dot(point - anchor_); }
  double height_of(const core::Vec2& point) const {
    return normal_.dot(point - anchor_) - offset_m_;
  }
  /// Of the line's place across itself.
  double variance_at(double along_m) const {
    return covariance_(1, 1) + along_m * (2 * covariance_(0, 1) + along_m * covariance_(0, 0));
  }

  /// Takes a sighting in, from a pose that is taken to be exact.
  void update(const Sighting& seen, const core::Pose2& T_map_lidar, std::size_t scan);
  /// Notes a sighting of a line that is known better by other means.
  void see(const Sighting& seen, const core::Pose2& T_map_lidar, std::size_t scan);
  /// Takes what an adjustment found.
  void set_line(double normal_rad, double offset_m);
  void set_covariance(const Eigen::Matrix2d& covariance) { covariance_ = covariance; }
  void extend(const core::Vec2& point);
  void set_extent(double begin_m, double end_m) {
    begin_m_ = begin_m;
    end_m_ = end_m;
  }

  std::uint32_t id = 0;  ///< that a mapper knows it by
  std::size_t sightings = 0;
  std::size_t first_scan = 0;
  std::size_t last_scan = 0;

 private:
  core::Vec2 anchor_;
  double normal_rad_;
  core::Vec2 normal_;
  double offset_m_ = 0;
  double begin_m_;
  double end_m_;
  Eigen::Matrix2d covariance_;
};

}  // namespace cornerd::survey
