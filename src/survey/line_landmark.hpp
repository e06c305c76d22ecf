// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>

#include <Eigen/Core>

#include "core/geometry/pose2.hpp"
#include "core/geometry/squared.hpp"

namespace cornerd::survey {

using core::squared;

/// A line that one scan measured along a wall face, in the lidar frame at the middle of the scan.
/// Angle and offset are independent at the centroid.
struct LineObservation {
  double normal_rad = 0;  ///< from the wall towards the lidar
  core::Vec2 centroid = core::Vec2::Zero();
  double sigma_angle_rad = 0;
  double sigma_offset_m = 0;
  double begin_m = 0;  ///< extent along the line from the centroid; free space is on the left
  double end_m = 0;    ///< of the direction from begin to end
  std::uint32_t support = 0;  ///< samples

  double length_m() const { return end_m - begin_m; }
};

/// Direction along a line whose left normal is `normal`.
inline core::Vec2 along(const core::Vec2& normal) { return {normal.y(), -normal.x()}; }

inline constexpr std::uint32_t kNoFace = 0xffffffff;

/// A line observation transformed into the map frame.
struct PlacedObservation {
  PlacedObservation(const LineObservation& seen, const core::Pose2& T_map_lidar);
  double normal_rad;
  core::Vec2 centroid;
  core::Vec2 first;  ///< ends of the observed part
  core::Vec2 last;
};

/// The line of one wall face in the map: normal.dot(p - anchor) = offset_m. The part from begin_m
/// to end_m, measured along the line from the anchor, was observed.
class LineLandmark {
 public:
  LineLandmark(const LineObservation& seen, const core::Pose2& T_map_lidar, std::size_t scan);

  double normal_rad() const { return normal_rad_; }
  const core::Vec2& normal() const { return normal_; }
  core::Vec2 direction() const { return along(normal_); }
  const core::Vec2& anchor() const { return anchor_; }
  double offset_m() const { return offset_m_; }
  double begin_m() const { return begin_m_; }
  double end_m() const { return end_m_; }
  double length_m() const { return end_m_ - begin_m_; }
  /// Of (angle [rad], offset at the anchor [m]).
  const Eigen::Matrix2d& covariance() const { return covariance_; }

  /// The point of the line that is `along_m` from the anchor.
  core::Vec2 at(double along_m) const {
    return anchor_ + offset_m_ * normal_ + along_m * direction();
  }
  core::Vec2 first() const { return at(begin_m_); }
  core::Vec2 last() const { return at(end_m_); }
  /// Coordinate of a point along the line, and its signed distance towards the free space.
  double along_of(const core::Vec2& point) const { return direction().dot(point - anchor_); }
  double height_of(const core::Vec2& point) const {
    return normal_.dot(point - anchor_) - offset_m_;
  }
  /// Variance (m^2) of the line's offset at a point along it.
  double variance_at(double along_m) const {
    return covariance_(1, 1) + along_m * (2 * covariance_(0, 1) + along_m * covariance_(0, 0));
  }

  /// Kalman update with an observation from a pose that is taken as exact.
  void update(const LineObservation& seen, const core::Pose2& T_map_lidar, std::size_t scan);
  /// Extends the face by an observation without changing the line.
  void see(const LineObservation& seen, const core::Pose2& T_map_lidar, std::size_t scan);
  /// Sets the result of an adjustment.
  void set_line(double normal_rad, double offset_m);
  void set_covariance(const Eigen::Matrix2d& covariance) { covariance_ = covariance; }
  void extend(const core::Vec2& point);
  void set_extent(double begin_m, double end_m) {
    begin_m_ = begin_m;
    end_m_ = end_m;
  }

  std::uint32_t id = 0;  ///< stable while a mapper adds and removes faces
  std::size_t observations = 0;
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
