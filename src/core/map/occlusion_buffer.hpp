// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "core/map/wall_map.hpp"

namespace cornerd::core {

/// A face relative to the viewpoint. From its free side it runs counter-clockwise.
struct VisibleFace {
  Vec2 from = Vec2::Zero();  ///< relative to the viewpoint
  Vec2 to = Vec2::Zero();
  double height_m = 0;  ///< distance of the viewpoint to the face's line
};

/// Upper bound of the visible range from a viewpoint in each of kSectors sectors of bearing. A face
/// closes the sectors it spans; two faces that meet close the sector in which they do.
class OcclusionBuffer {
 public:
  static constexpr std::size_t kSectors = 64;

  void reset(double max_range_m);

  /// True where part of the face may be visible; the face then occludes what is behind it.
  bool add(const Face& face, const VisibleFace& visible);

  /// False only where nothing in the box around `direction` (relative to the viewpoint) with half
  /// side `half_size_m` is visible.
  bool may_be_visible(const Vec2& direction, double half_size_m) const;

  /// Upper bound of the visible range in any direction.
  double max_range_m() const;

  /// One bit per sector.
  using Sectors = std::uint64_t;
  static_assert(kSectors == 64);

  /// Sectors with a visible range beyond `near_m`.
  Sectors open_sectors(double near_m) const;
  /// Sectors that a box around `direction` with half side `half_size_m` reaches into.
  static Sectors sectors_of(const Vec2& direction, double half_size_m);

 private:
  /// Gap between two faces, as a share of a sector, that counts as closed: ten micrometres at 0.3
  /// m, a tenth of an A1's step in bearing. Ends of faces that meet are kGeometryEpsilon_m apart.
  static constexpr double kGap = 3e-4;

  /// A face that covers this share of a sector, from one of its sides.
  struct Cover {
    double share = 0;
    double squared_range = 0;  ///< of its farther end in the sector, m^2
  };
  /// The nearest cover and the widest. The walls of a room's corner are the nearest from both
  /// sides; behind a doorpost the wall beyond is the widest.
  struct Side {
    Cover nearest;
    Cover widest;
  };
  struct Sector {
    double squared_range = 0;  ///< nothing farther is visible, m^2
    Side begin;
    Side end;
    void close(const Cover& one, const Cover& other);
    void cover(Side& side, const Side& opposite, const Cover& cover);
  };
  std::array<Sector, kSectors> sectors_{};
};

}  // namespace cornerd::core
