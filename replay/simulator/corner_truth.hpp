// SPDX-License-Identifier: MIT
// Which corners a turn shows: from the map, the place and the returns, never from a detector.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/map/ray_caster.hpp"
#include "core/map/wall_map.hpp"
#include "core/polar_scan.hpp"

namespace cornerd::replay {

/// How much of a corner a turn shows. A corner is in sight where nothing stands between it and the
/// lidar; the end of a wall has two, one thickness apart, of which usually one alone shows both its
/// faces.
enum class CornerView : std::uint8_t {
  kSupported,  ///< in sight, each wall gives at least kSupportReturns
  kVisible,    ///< in sight, each wall gives a return, one of them fewer than that
  kOneSided,   ///< in sight, but one of its walls alone gives returns: a wall's end
  kHidden,     ///< both walls give returns, the corner itself is behind something
};

/// Fewer returns than these make no wall (El Amin et al., section V.B: "more than four points").
inline constexpr std::uint32_t kSupportReturns = 5;

struct CornerObservation {
  std::uint32_t corner = 0;                  ///< index into WallMap::corners()
  core::Vec2 position = core::Vec2::Zero();  ///< lidar frame
  CornerView view = CornerView::kHidden;
  std::uint32_t left_returns = 0;  ///< of the turn, on the whole face to the left of the corner
  std::uint32_t right_returns = 0;
};

/// The corners of one map as turns show them. A return is one of a face where a ray without noise,
/// at the bearing that the sample claims, meets that face first, and the range agrees: returns that
/// are missing, or wrong altogether, count for nothing.
class CornerTruth {
 public:
  /// `map` has to outlive this.
  CornerTruth(const core::WallMap& map, double max_range_m);

  void observe(const core::Pose2& T_map_lidar, std::span<const core::PolarPoint> points);

  /// Of the last turn: all corners of which at least one wall gave a return and that are in sight,
  /// and the hidden ones of which both did.
  std::span<const CornerObservation> corners() const { return corners_; }

  /// Where the turn's view of a wall ends because a nearer wall hides how it goes on: the last
  /// return before that, lidar frame. Such a place is no corner, though it is where a line of
  /// returns ends.
  std::span<const core::Vec2> occlusion_edges() const { return occlusion_edges_; }

 private:
  /// The part of a face that one side of a corner is.
  struct Side {
    std::uint32_t face = core::PredictedHit::kNone;
    double from_m = 0;  ///< along the face
    double to_m = 0;
  };
  struct Sides {
    Side left;
    Side right;
  };
  /// A return, as the map explains it.
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
  std::vector<Sides> sides_;  ///< as the map's corners
  std::vector<WallHit> hits_;
  std::vector<CornerObservation> corners_;
  std::vector<core::Vec2> occlusion_edges_;
};

}  // namespace cornerd::replay
