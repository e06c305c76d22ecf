// SPDX-License-Identifier: MIT
// Which corners of a map a scan shows: from map, true pose and returns, without a detector.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/map/ray_caster.hpp"
#include "core/map/wall_map.hpp"
#include "core/polar_scan.hpp"

namespace cornerd::replay {

/// How much of a corner a scan shows. A corner is visible if no wall is between it and the lidar.
/// The end of a wall has two corners, of which usually only one shows both its faces.
enum class CornerView : std::uint8_t {
  kSupported,  ///< visible, at least kSupportReturns returns on each face
  kVisible,    ///< visible, fewer returns on one face, at least one
  kOneSided,   ///< visible, returns on one face only: a wall's end
  kHidden,     ///< occluded, returns on both faces
};

/// Least returns of a wall (El Amin et al., section V.B: "more than four points").
inline constexpr std::uint32_t kSupportReturns = 5;

struct CornerObservation {
  std::uint32_t corner = 0;                  ///< index into WallMap::corners()
  core::Vec2 position = core::Vec2::Zero();  ///< lidar frame
  CornerView view = CornerView::kHidden;
  std::uint32_t left_returns = 0;  ///< on the whole face to the left of the corner
  std::uint32_t right_returns = 0;
};

/// Finds the corners of a map in scans of known pose. A return belongs to the face that a ray at
/// its bearing hits first, if the ranges agree to 5 cm + 5 %.
class CornerTruth {
 public:
  /// `map` must outlive this.
  CornerTruth(const core::WallMap& map, double max_range_m);

  void observe(const core::Pose2& T_map_lidar, std::span<const core::PolarPoint> points);

  /// Of the last scan: visible corners with a return on a face, hidden ones with returns on both.
  std::span<const CornerObservation> corners() const { return corners_; }

  /// Last returns of faces before a nearer wall occludes them, lidar frame. No corners, although a
  /// line
  /// of returns ends there.
  std::span<const core::Vec2> occlusion_edges() const { return occlusion_edges_; }

 private:
  /// One side of a corner: a part of a face.
  struct Side {
    std::uint32_t face = core::PredictedHit::kNone;
    double from_m = 0;  ///< along the face
    double to_m = 0;
  };
  struct Sides {
    Side left;
    Side right;
  };
  /// A return on a face of the map.
  struct WallHit {
    std::uint32_t face = core::PredictedHit::kNone;
    double along_m = 0;
    double range_m = 0;
    std::uint32_t point = 0;
  };

  Side side_of(const core::Vec2& position, double direction_rad, bool left) const;
  bool has_line_of_sight(const core::Vec2& origin, const core::Vec2& corner) const;
  std::uint32_t returns_of(const Side& side) const;
  bool are_neighbours(std::uint32_t face, std::uint32_t other) const;
  void find_occlusion_edges(std::span<const core::PolarPoint> points);

  const core::WallMap& map_;
  core::RayCaster ray_caster_;
  std::vector<Sides> sides_;  ///< by index of the map's corners
  std::vector<WallHit> hits_;
  std::vector<CornerObservation> corners_;
  std::vector<core::Vec2> occlusion_edges_;
};

}  // namespace cornerd::replay
