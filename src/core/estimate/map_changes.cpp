// SPDX-License-Identifier: MIT
#include "core/estimate/map_changes.hpp"

#include <algorithm>
#include <cmath>

#include "core/estimate/face_walls.hpp"

namespace cornerd::core {
namespace {

constexpr TimeNs kLookEvery_ns = 1'000'000'000;
constexpr double kFinestCell_m = 0.1;
constexpr std::size_t kMostCells = 1U << 16U;
/// Beyond a wall or before it by more than this and three sigmas of its offset: not on it.
constexpr double kOffWall_m = 0.1;
constexpr double kOffWallSigmas = 3;
/// Rays that show a wall, and their shares through it and on it.
constexpr std::uint32_t kMinRays = 10;
constexpr double kThroughShare = 0.7;
constexpr double kOnWallShare = 0.5;
/// Scans, a second apart, until a wall counts as gone and a thing as one that stays. Few people
/// stand still for a minute.
constexpr std::uint8_t kLooksUntilGone = 20;
constexpr std::uint8_t kLooksUntilThere = 60;
constexpr std::uint8_t kMostLooks = 120;
constexpr std::uint8_t kLooksPerFreeRay = 2;
/// Cells of one thing.
constexpr double kOneThing_m = 0.5;

constexpr std::uint8_t kFreeCell = 1;
constexpr std::uint8_t kOccupiedCell = 2;

}  // namespace

MapChanges::MapChanges(const WallMap& map, double max_range_m)
    : ray_caster_(max_range_m),
      looks_(map.plan().walls.size()),
      gone_(map.plan().walls.size()),
      low_(map.lower_left()) {
  for (const FaceWall& side : face_walls(map)) {
    walls_of_faces_.push_back(side.sign == 0 ? -1 : static_cast<std::int32_t>(side.wall));
  }
  const Vec2 size = map.upper_right() - low_;
  cell_m_ = std::max(kFinestCell_m, std::sqrt(size.x() * size.y() / (kMostCells / 2.0)));
  columns_ = static_cast<std::size_t>(size.x() / cell_m_) + 1;
  occupied_.resize(columns_ * (static_cast<std::size_t>(size.y() / cell_m_) + 1));
  now_.resize(occupied_.size());
  changes_.reserve(kMaxChanges);
}

void MapChanges::resume(std::span<const MapChange> changes) {
  for (const MapChange& change : changes) {
    if (change.kind == MapChange::Kind::kWallGone) {
      if (change.wall >= gone_.size() || gone_[change.wall] == kLooksUntilGone) continue;
      gone_[change.wall] = kLooksUntilGone;
    } else {
      const std::size_t cell = cell_at(change.position);
      if (cell >= occupied_.size()) continue;
      occupied_[cell] = kLooksUntilThere;
    }
    report(change);
  }
}

std::size_t MapChanges::cell_at(const Vec2& point) const {
  const Vec2 at = (point - low_) / cell_m_;
  const std::size_t rows = occupied_.size() / columns_;
  if (!(at.x() >= 0 && at.y() >= 0 && at.x() < static_cast<double>(columns_) &&
        at.y() < static_cast<double>(rows))) {
    return occupied_.size();
  }
  return static_cast<std::size_t>(at.y()) * columns_ + static_cast<std::size_t>(at.x());
}

void MapChanges::count_ray(const Vec2& origin, const Vec2& end, bool is_short) {
  const double range_m = (end - origin).norm();
  const Vec2 step = (end - origin) * (cell_m_ / range_m);
  // The last cell is not free, nor one that a grazing ray leaves in part.
  const auto steps = static_cast<std::size_t>(std::max(0.0, range_m / cell_m_ - 1.5));
  Vec2 at = origin;
  for (std::size_t k = 0; k < steps; ++k, at += step) {
    const std::size_t cell = cell_at(at);
    if (cell < now_.size() && now_[cell] == 0) now_[cell] = kFreeCell;
  }
  if (!is_short) return;
  if (const std::size_t cell = cell_at(end); cell < now_.size()) now_[cell] = kOccupiedCell;
}

void MapChanges::add(const WallMap& map, const Pose2& T_map_lidar,
                     std::span<const PolarPoint> points, double sigma_m, TimeNs t_ns) {
  if (t_ns >= last_ns_ && t_ns - last_ns_ < kLookEvery_ns) return;
  last_ns_ = t_ns;
  const double off_wall_m = kOffWall_m + kOffWallSigmas * sigma_m;
  const auto hits = ray_caster_.cast(map, T_map_lidar, points);
  std::fill(looks_.begin(), looks_.end(), WallLook());
  std::fill(now_.begin(), now_.end(), std::uint8_t{0});
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (hits[i].face == PredictedHit::kNone) continue;
    const Vec2 end = T_map_lidar * Vec2(points[i].x_m, points[i].y_m);
    const Face& face = map.faces()[hits[i].face];
    const double before_m = face.normal.dot(end) - face.offset_m;
    count_ray(T_map_lidar.translation(), end, before_m > off_wall_m);
    const std::int32_t wall = walls_of_faces_[hits[i].face];
    if (wall < 0) continue;
    WallLook& look = looks_[static_cast<std::size_t>(wall)];
    ++look.rays;
    look.through += before_m < -off_wall_m ? 1 : 0;
    look.on_wall += std::abs(before_m) <= off_wall_m ? 1 : 0;
  }
  // What is no longer so is forgotten; the rest stays in its order.
  std::erase_if(changes_, [&](const MapChange& change) {
    if (change.kind == MapChange::Kind::kWallGone) {
      const WallLook& look = looks_[change.wall];
      return look.rays >= kMinRays && look.on_wall > kOnWallShare * look.rays;
    }
    const std::size_t cell = cell_at(change.position);
    return cell < occupied_.size() && occupied_[cell] == 0;
  });
  end_look();
  update_things();
}

void MapChanges::end_look() {
  for (std::size_t i = 0; i < looks_.size(); ++i) {
    const WallLook& look = looks_[i];
    if (look.rays < kMinRays) continue;
    if (look.on_wall > kOnWallShare * look.rays) gone_[i] = 0;
    if (look.through < kThroughShare * look.rays || gone_[i] == kLooksUntilGone) continue;
    if (++gone_[i] == kLooksUntilGone) {
      report({MapChange::Kind::kWallGone, static_cast<std::uint32_t>(i), Vec2::Zero()});
    }
  }
}

void MapChanges::update_things() {
  for (std::size_t cell = 0; cell < now_.size(); ++cell) {
    std::uint8_t& looks = occupied_[cell];
    if (now_[cell] == kFreeCell) {
      looks = static_cast<std::uint8_t>(looks - std::min(looks, kLooksPerFreeRay));
    } else if (now_[cell] == kOccupiedCell && looks < kMostLooks && ++looks == kLooksUntilThere) {
      const std::size_t row = cell / columns_;
      const Vec2 index(static_cast<double>(cell % columns_), static_cast<double>(row));
      report({MapChange::Kind::kNewThing, 0, low_ + cell_m_ * (index + Vec2(0.5, 0.5))});
    }
  }
}

void MapChanges::report(const MapChange& change) {
  const bool is_known = std::any_of(changes_.begin(), changes_.end(), [&](const MapChange& other) {
    return change.kind == MapChange::Kind::kNewThing && other.kind == change.kind &&
           (other.position - change.position).norm() < kOneThing_m;
  });
  if (!is_known && changes_.size() < kMaxChanges) changes_.push_back(change);
}

}  // namespace cornerd::core
