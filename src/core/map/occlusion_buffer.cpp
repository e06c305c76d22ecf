// SPDX-License-Identifier: MIT
#include "core/map/occlusion_buffer.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

namespace cornerd::core {
namespace {

constexpr double kPerQuarter = OcclusionBuffer::kSectors / 4.0;

/// Monotonic in the direction's angle, from 0 to kSectors, without trigonometry: the position along
/// the square |x| + |y| = 1.
double sector_position(const Vec2& direction) {
  const double share = direction.y() / (std::abs(direction.x()) + std::abs(direction.y()));
  if (direction.x() < 0) return kPerQuarter * (2 - share);
  return kPerQuarter * (direction.y() >= 0 ? share : 4 + share);
}

/// Directions of the sectors' borders on that square, and their squared lengths.
struct Borders {
  std::array<Vec2, OcclusionBuffer::kSectors> directions;
  std::array<double, OcclusionBuffer::kSectors> squares;
  Borders() {
    for (std::size_t i = 0; i < OcclusionBuffer::kSectors; ++i) {
      const double position = static_cast<double>(i) / kPerQuarter;
      const double share = position - std::floor(position);
      Vec2 direction(1 - share, share);
      for (int quarter = 0; quarter < static_cast<int>(position); ++quarter)
        direction = rotate_left(direction);
      directions[i] = direction;
      squares[i] = direction.squaredNorm();
    }
  }
};
const Borders kBorders;

std::size_t sector_of(double position) {
  return std::min(static_cast<std::size_t>(position), OcclusionBuffer::kSectors - 1);
}
std::size_t after(std::size_t sector) { return (sector + 1) % OcclusionBuffer::kSectors; }

}  // namespace

void OcclusionBuffer::reset(double max_range_m) {
  Sector open;
  open.squared_range = max_range_m * max_range_m;
  sectors_.fill(open);
}

void OcclusionBuffer::Sector::close(const Cover& one, const Cover& other) {
  if (one.share + other.share < 1 - kGap) return;
  squared_range = std::min(squared_range, std::max(one.squared_range, other.squared_range));
}

void OcclusionBuffer::Sector::cover(Side& side, const Side& opposite, const Cover& cover) {
  close(cover, opposite.nearest);
  close(cover, opposite.widest);
  if (side.nearest.share == 0 || cover.squared_range < side.nearest.squared_range)
    side.nearest = cover;
  if (cover.share > side.widest.share) side.widest = cover;
}

bool OcclusionBuffer::add(const Face& face, const VisibleFace& visible) {
  const double squared_from = visible.from.squaredNorm();
  const double squared_to = visible.to.squaredNorm();
  const double along_m = -face.direction.dot(visible.from);
  const double squared_nearest = along_m <= 0               ? squared_from
                                 : along_m >= face.length_m ? squared_to
                                                            : visible.height_m * visible.height_m;
  if (squared_from == 0 || squared_to == 0) return true;
  const double from = sector_position(visible.from);
  const double to = sector_position(visible.to);
  const std::size_t first = sector_of(from);
  const std::size_t last = sector_of(to);
  bool is_seen = sectors_[first].squared_range > squared_nearest;
  for (std::size_t i = first; !is_seen && i != last;) {
    i = after(i);
    is_seen = sectors_[i].squared_range > squared_nearest;
  }
  // A span over pi is a face seen edge-on whose ends rounding has swapped.
  const std::size_t span = (last + kSectors - first) % kSectors;
  if (!is_seen || span == 0 || span > kSectors / 2) return is_seen;

  const auto square_at_border = [&](std::size_t i) {
    const double approach = -face.normal.dot(kBorders.directions[i]);
    return approach > 0
               ? visible.height_m * visible.height_m * kBorders.squares[i] / (approach * approach)
               : std::numeric_limits<double>::infinity();
  };
  double squared_border = square_at_border(after(first));
  Sector& begin = sectors_[first];
  begin.cover(begin.end, begin.begin,
              {1 - (from - static_cast<double>(first)), std::max(squared_from, squared_border)});
  for (std::size_t i = after(first); i != last; i = after(i)) {
    const double squared_next = square_at_border(after(i));
    sectors_[i].squared_range =
        std::min(sectors_[i].squared_range, std::max(squared_border, squared_next));
    squared_border = squared_next;
  }
  Sector& end = sectors_[last];
  end.cover(end.begin, end.end,
            {to - static_cast<double>(last), std::max(squared_to, squared_border)});
  return true;
}

OcclusionBuffer::Sectors OcclusionBuffer::sectors_of(const Vec2& direction, double half_size_m) {
  const double radius_m = half_size_m * 1.4143;
  const double distance_m =
      std::abs(direction.x()) + std::abs(direction.y());  // at most sqrt(2) times the norm
  if (direction.squaredNorm() <= 4 * radius_m * radius_m) return ~Sectors{0};
  // d(position)/d(angle) is at most kPerQuarter, and asin(x) <= x pi/3 for x <= 1/2.
  const double aside = kPerQuarter * 1.0473 * radius_m * 1.4143 / distance_m;
  const double low = sector_position(direction) - aside;
  const auto count = static_cast<int>(2 * aside) + 2;  // of sectors: less than half of all
  const auto first = static_cast<int>(low + static_cast<double>(kSectors)) - 64;
  return std::rotl((Sectors{1} << count) - 1, first);
}

OcclusionBuffer::Sectors OcclusionBuffer::open_sectors(double near_m) const {
  const double squared_nearest = near_m > 0 ? near_m * near_m : 0;
  Sectors open = 0;
  for (std::size_t i = 0; i < kSectors; ++i) {
    open |= static_cast<Sectors>(sectors_[i].squared_range > squared_nearest) << i;
  }
  return open;
}

bool OcclusionBuffer::may_be_visible(const Vec2& direction, double half_size_m) const {
  const double near_m = direction.norm() - half_size_m * 1.4143;
  Sectors sectors = sectors_of(direction, half_size_m);
  for (; sectors != 0; sectors &= sectors - 1) {
    const Sector& sector = sectors_[static_cast<std::size_t>(std::countr_zero(sectors))];
    if (near_m <= 0 || sector.squared_range > near_m * near_m) return true;
  }
  return false;
}

double OcclusionBuffer::max_range_m() const {
  double squared_range = 0;
  for (const Sector& sector : sectors_)
    squared_range = std::max(squared_range, sector.squared_range);
  return std::sqrt(squared_range);
}

}  // namespace cornerd::core
