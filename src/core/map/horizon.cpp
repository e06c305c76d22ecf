// SPDX-License-Identifier: MIT
#include "core/map/horizon.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

namespace cornerd::core {
namespace {

constexpr double kPerQuarter = Horizon::kSectors / 4.0;

/// Grows with the direction's angle from 0 to kSectors, without trigonometry: the way around the
/// square |x| + |y| = 1.
double sector_position(const Vec2& way) {
  const double share = way.y() / (std::abs(way.x()) + std::abs(way.y()));
  if (way.x() < 0) return kPerQuarter * (2 - share);
  return kPerQuarter * (way.y() >= 0 ? share : 4 + share);
}

/// The directions in which the sectors begin, on that square, and the square of their lengths.
struct Borders {
  std::array<Vec2, Horizon::kSectors> ways;
  std::array<double, Horizon::kSectors> squares;
  Borders() {
    for (std::size_t i = 0; i < Horizon::kSectors; ++i) {
      const double position = static_cast<double>(i) / kPerQuarter;
      const double share = position - std::floor(position);
      Vec2 way(1 - share, share);
      for (int quarter = 0; quarter < static_cast<int>(position); ++quarter) way = rotate_left(way);
      ways[i] = way;
      squares[i] = way.squaredNorm();
    }
  }
};
const Borders kBorders;

std::size_t sector_of(double position) {
  return std::min(static_cast<std::size_t>(position), Horizon::kSectors - 1);
}
std::size_t after(std::size_t sector) { return (sector + 1) % Horizon::kSectors; }

}  // namespace

void Horizon::reset(double reach_m) {
  Sector open;
  open.far_m2 = reach_m * reach_m;
  sectors_.fill(open);
}

void Horizon::Sector::close(const Cover& one, const Cover& other) {
  if (one.share + other.share < 1 - kGap) return;
  far_m2 = std::min(far_m2, std::max(one.far_m2, other.far_m2));
}

void Horizon::Sector::cover(Side& side, const Side& opposite, const Cover& cover) {
  close(cover, opposite.nearest);
  close(cover, opposite.widest);
  if (side.nearest.share == 0 || cover.far_m2 < side.nearest.far_m2) side.nearest = cover;
  if (cover.share > side.widest.share) side.widest = cover;
}

bool Horizon::add(const Face& face, const FaceInSight& seen) {
  const double from_m2 = seen.from.squaredNorm();
  const double to_m2 = seen.to.squaredNorm();
  const double along_m = -face.direction.dot(seen.from);
  const double near_m2 = along_m <= 0               ? from_m2
                         : along_m >= face.length_m ? to_m2
                                                    : seen.height_m * seen.height_m;
  if (from_m2 == 0 || to_m2 == 0) return true;
  const double from = sector_position(seen.from);
  const double to = sector_position(seen.to);
  const std::size_t first = sector_of(from);
  const std::size_t last = sector_of(to);
  bool is_seen = sectors_[first].far_m2 > near_m2;
  for (std::size_t i = first; !is_seen && i != last;) {
    i = after(i);
    is_seen = sectors_[i].far_m2 > near_m2;
  }
  // Over more than half a turn: a face that is seen edge-on, where rounding has swapped its ends.
  const std::size_t span = (last + kSectors - first) % kSectors;
  if (!is_seen || span == 0 || span > kSectors / 2) return is_seen;

  const auto square_at_border = [&](std::size_t i) {
    const double approach = -face.normal.dot(kBorders.ways[i]);
    return approach > 0
               ? seen.height_m * seen.height_m * kBorders.squares[i] / (approach * approach)
               : std::numeric_limits<double>::infinity();
  };
  double border_m2 = square_at_border(after(first));
  Sector& begin = sectors_[first];
  begin.cover(begin.end, begin.begin,
              {1 - (from - static_cast<double>(first)), std::max(from_m2, border_m2)});
  for (std::size_t i = after(first); i != last; i = after(i)) {
    const double next_m2 = square_at_border(after(i));
    sectors_[i].far_m2 = std::min(sectors_[i].far_m2, std::max(border_m2, next_m2));
    border_m2 = next_m2;
  }
  Sector& end = sectors_[last];
  end.cover(end.begin, end.end, {to - static_cast<double>(last), std::max(to_m2, border_m2)});
  return true;
}

Horizon::Sectors Horizon::around(const Vec2& way, double half_size_m) {
  const double radius_m = half_size_m * 1.4143;
  const double distance_m =
      std::abs(way.x()) + std::abs(way.y());  // at most sqrt(2) times too much
  if (way.squaredNorm() <= 4 * radius_m * radius_m) return ~Sectors{0};
  // A direction's position grows by at most kPerQuarter for each radian; the arc sine of at most a
  // half by at most pi/3 times it.
  const double aside = kPerQuarter * 1.0473 * radius_m * 1.4143 / distance_m;
  const double low = sector_position(way) - aside;
  const auto count = static_cast<int>(2 * aside) + 2;  // of sectors: fewer than half of all
  const auto first = static_cast<int>(low + static_cast<double>(kSectors)) - 64;
  return std::rotl((Sectors{1} << count) - 1, first);
}

Horizon::Sectors Horizon::open_beyond(double near_m) const {
  const double near_m2 = near_m > 0 ? near_m * near_m : 0;
  Sectors open = 0;
  for (std::size_t i = 0; i < kSectors; ++i) {
    open |= static_cast<Sectors>(sectors_[i].far_m2 > near_m2) << i;
  }
  return open;
}

bool Horizon::may_see(const Vec2& way, double half_size_m) const {
  const double near_m = way.norm() - half_size_m * 1.4143;
  Sectors sectors = around(way, half_size_m);
  for (; sectors != 0; sectors &= sectors - 1) {
    const Sector& sector = sectors_[static_cast<std::size_t>(std::countr_zero(sectors))];
    if (near_m <= 0 || sector.far_m2 > near_m * near_m) return true;
  }
  return false;
}

double Horizon::farthest_m() const {
  double far_m2 = 0;
  for (const Sector& sector : sectors_) far_m2 = std::max(far_m2, sector.far_m2);
  return std::sqrt(far_m2);
}

}  // namespace cornerd::core
