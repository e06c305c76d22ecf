// SPDX-License-Identifier: MIT
#include "tool/map/learned_map.hpp"

#include <algorithm>
#include <system_error>

#include "replay/simulator/map_error.hpp"
#include "settings/document.hpp"
#include "tool/command_line/failure.hpp"

namespace cornerd::tool {
namespace {

/// Of the packaged service.
constexpr const char* kStateFolder = "/var/lib/cornerd";
/// The format's least sigma of a wall.
constexpr double kLeastSigma_m = 0.001;

}  // namespace

std::filesystem::path learned_walls_file(const core::FloorPlan& plan,
                                         const std::filesystem::path& given) {
  if (!given.empty()) return given;
  return kStateFolder / std::filesystem::path(settings::learned_walls_name(plan.hash));
}

settings::LearnedWallsOfMap load_learned_walls(const core::FloorPlan& plan,
                                               const std::filesystem::path& file) {
  std::error_code unread;
  if (std::filesystem::status(file, unread).type() == std::filesystem::file_type::not_found) {
    throw Failure(file.string() +
                  ": is not there: the daemon has learned nothing of this map, or keeps it in "
                  "another /advanced/localizer/walls_folder; --walls FILE gives it");
  }
  settings::LearnedWallsOfMap learned = settings::parse_learned_walls(
      settings::read_file(file, settings::kMaxLearnedWallsBytes), file);
  if (learned.map_hash != plan.hash) {
    throw Failure(file.string() +
                  ": was learned in another map; give the map that the daemon used");
  }
  if (!learned.fits(plan.walls.size())) {
    throw Failure(file.string() + ": has a wall that the map has not; give the map's own file");
  }
  return learned;
}

core::FloorPlan with_learned_walls(const core::FloorPlan& plan, const core::LearnedWalls& walls) {
  std::vector<double> by_m(plan.walls.size());
  for (const core::WallOffset& wall : walls.offsets) by_m[wall.wall] = wall.offset_m;
  core::FloorPlan moved = replay::with_walls_moved(plan, by_m);
  for (const core::WallOffset& wall : walls.offsets) {
    moved.walls[wall.wall].sigma_m = std::max(wall.sigma_m, kLeastSigma_m);
  }
  return moved;
}

core::FloorPlan without_gone_walls(core::FloorPlan plan,
                                   const std::vector<core::MapChange>& changes) {
  std::vector<bool> gone(plan.walls.size());
  for (const core::MapChange& change : changes) {
    if (change.kind == core::MapChange::Kind::kWallGone) gone[change.wall] = true;
  }
  std::size_t index = 0;
  std::erase_if(plan.walls, [&](const core::Wall&) { return gone[index++]; });
  return plan;
}

}  // namespace cornerd::tool
