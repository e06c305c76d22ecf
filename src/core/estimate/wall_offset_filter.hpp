// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/estimate/face_walls.hpp"
#include "core/estimate/point_lanes.hpp"
#include "core/map/wall_map.hpp"

namespace cornerd::core {

/// A wall's offset across itself, to the left of the direction from its first point to its second.
struct WallOffset {
  std::size_t wall = 0;  ///< index into FloorPlan::walls
  double offset_m = 0;
  double sigma_m = 0;
};

/// What was learned of a map's walls.
struct LearnedWalls {
  std::vector<WallOffset> offsets;
  std::vector<double> covariance_m2;  ///< its lower triangle, by rows
};

/// Kalman filter of the walls' offsets from the map: simultaneous localization and mapping whose
/// landmarks have a prior, the plan's sigma. Each scan's pose is marginalised with no prior of its
/// own, so that a scan measures walls relative to each other only: the plan fixes the frame. The
/// joint covariance keeps what the walls have in common, a frame that is off as a whole, and a pose
/// that rests on them is as uncertain. Allocates nothing after construction.
class WallOffsetFilter {
 public:
  /// Walls that can be learned, the first that are seen; others keep their prior.
  static constexpr std::size_t kMaxWalls = 256;

  explicit WallOffsetFilter(const WallMap& map);

  /// Of the face's plane along its normal.
  double offset_m(std::uint32_t face) const;
  /// Of one scan's points on the face about the map's plane moved by offset_m(); 0: not a side of a
  /// wall, but its end.
  double sigma_m(std::uint32_t face) const;

  /// A scan's normal equations with the offsets eliminated, and what that took of them.
  struct Reduced {
    Eigen::Matrix3d information = Eigen::Matrix3d::Zero();
    Eigen::Vector3d gradient = Eigen::Vector3d::Zero();
    double chi_square = 0;
  };
  /// Starts a scan's normal equations. `direction_share`: shown_direction_share(). The part of a
  /// turned wall that a scan sees is off by another offset than the whole.
  void begin(double direction_share = 0) {
    count_ = 0;
    direction_share_ = direction_share;
  }
  /// `sums`: of residuals about the moved plane; `rays`: predicted on the face, in a row. False
  /// where they tell nothing of the wall: most of them went elsewhere, it is not the side of a
  /// wall, or there is no room.
  bool add(std::uint32_t face, const Vec2& normal, const FaceSums& sums, std::size_t rays);
  /// Schur complement over all walls added since begin().
  Reduced marginalise();

  /// Takes the scan that marginalise() was last called for. `covariance`: of its pose, given this
  /// filter, at which the gradient is zero. False, and nothing is learned, where the scan
  /// contradicts what is known.
  bool learn(const Covariance3& covariance);
  /// The walls of that scan are where the map has them, by its sigma.
  void forget_visible();

  /// Of the walls learned so far.
  std::size_t size() const { return slots_.size(); }
  WallOffset operator[](std::size_t slot) const;
  double covariance_m2(std::size_t one, std::size_t other) const {
    return covariance_[one * capacity_ + other];
  }
  /// Allocates nothing where `learned` has room for kMaxWalls.
  void copy_to(LearnedWalls& learned) const;
  /// Replaces all. False, and nothing changes, where it is impossible: its sizes, a wall that is
  /// not there or twice, or a covariance that is not positive.
  bool resume(const LearnedWalls& learned);
  void forget();

 private:
  static constexpr std::size_t kMaxVisible = 48;
  static constexpr std::uint32_t kNone = 0xffffffff;

  struct WallState {
    std::uint32_t slot = kNone;
    double prior_variance_m2 = 0;
  };
  struct Visible {
    std::uint32_t wall = 0;
    double weight = 0;
    Eigen::Vector3d by_pose = Eigen::Vector3d::Zero();  ///< weighted sum of the Jacobians
    double distance = 0;                                ///< weighted sum of the residuals
  };
  double prior_covariance_m2(const Visible& one, const Visible& other) const;
  /// Of one scan's points on a wall about its offset.
  double scan_variance_m2(const WallState& wall) const;
  void assign_slots();
  double& at(std::size_t one, std::size_t other) { return covariance_[one * capacity_ + other]; }

  std::vector<FaceWall> sides_;    ///< of the faces
  std::vector<WallState> states_;  ///< of the walls
  std::size_t capacity_;
  std::vector<std::uint32_t> slots_;  ///< the walls learned
  std::vector<double> means_m_;
  std::vector<double> covariance_;  ///< capacity_ x capacity_

  // Of the scan in progress.
  std::array<Visible, kMaxVisible> visible_;
  std::size_t count_ = 0;
  double direction_share_ = 0;
  std::array<std::array<double, kMaxVisible>, kMaxVisible> factor_{};  ///< Cholesky's L of B
  std::array<Eigen::Vector4d, kMaxVisible> whitened_;  ///< L^-1 of Jacobian and residual
  std::vector<double> rows_;                           ///< of covariance_, of the visible walls
  std::vector<double> gains_;
};

}  // namespace cornerd::core
