// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "core/map/wall_map.hpp"

namespace cornerd::core {

/// A face as it lies around a place. Seen from its free side it runs counter-clockwise.
struct FaceInSight {
  Vec2 from = Vec2::Zero();  ///< from the place
  Vec2 to = Vec2::Zero();
  double height_m = 0;  ///< distance of the place to the face's line
};

/// How far one can see from a place at most, in each of a number of sectors. Faces that are added
/// close the sectors that they cover, two that meet close the one in which they do.
class Horizon {
 public:
  static constexpr std::size_t kSectors = 64;

  void reset(double reach_m);

  /// True where some of the face may be seen; then it closes what it covers.
  bool add(const Face& face, const FaceInSight& seen);

  /// True where something within `half_size_m` of the middle of a box, which is `way` off, may be
  /// seen. Never false where it is.
  bool may_see(const Vec2& way, double half_size_m) const;

  /// What is farther off than this is not seen in any direction.
  double farthest_m() const;

  /// A bit for each sector.
  using Sectors = std::uint64_t;
  static_assert(kSectors == 64);

  /// Those in which one may see beyond a distance.
  Sectors open_beyond(double near_m) const;
  /// Those that something within `half_size_m` of the middle of a box, which is `way` off, may
  /// reach into.
  static Sectors around(const Vec2& way, double half_size_m);

 private:
  /// Two faces that leave no more than this share of a sector open between them leave nothing: ten
  /// micrometres a third of a metre away, a tenth of an A1's step between bearings. Faces that meet
  /// do so but for the micrometre that kGeometryEpsilon_m takes off their ends.
  static constexpr double kGap = 3e-4;

  /// What covers a sector from one of its sides on: this share of it, and how far it lies.
  struct Cover {
    double share = 0;
    double far_m2 = 0;  ///< squared
  };
  /// The nearest such cover and the widest. A room's walls cover their corner's sector as the
  /// nearest from both sides; where a doorpost stands in one, the wall beyond is the widest.
  struct Side {
    Cover nearest;
    Cover widest;
  };
  struct Sector {
    double far_m2 = 0;  ///< nothing is seen beyond, squared
    Side begin;
    Side end;
    void close(const Cover& one, const Cover& other);
    void cover(Side& side, const Side& opposite, const Cover& cover);
  };
  std::array<Sector, kSectors> sectors_{};
};

}  // namespace cornerd::core
