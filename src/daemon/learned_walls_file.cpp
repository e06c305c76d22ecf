// SPDX-License-Identifier: MIT
#include "daemon/learned_walls_file.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <exception>
#include <system_error>

#include "daemon/log.hpp"
#include "daemon/replace_file.hpp"
#include "settings/document.hpp"
#include "settings/learned_walls.hpp"

namespace cornerd::daemon {
namespace {

/// A change that is worth a write: of an offset by its sigma, or of a sigma by a fifth.
constexpr double kWorthSigmas = 1;
constexpr double kWorthRatio = 0.8;

}  // namespace

std::filesystem::path learned_walls_folder(const settings::Config& config) {
  if (config.lidar.driver == settings::DriverKind::kReplay) return {};
  if (!config.walls_folder.empty()) return config.walls_folder;
  const char* const folder = std::getenv("STATE_DIRECTORY");
  return folder == nullptr ? std::filesystem::path() : std::filesystem::path(folder);
}

void LearnedWallsFile::resume(core::Localizer& localizer, const core::WallMap& map) {
  if (hash_ != map.plan().hash) walls_ = load(map.plan().hash, map.plan().walls.size());
  if (!walls_.offsets.empty()) localizer.resume(walls_);
}

std::unique_ptr<WallReport> LearnedWallsFile::update(Localization& localization,
                                                     const core::WallMap* map) {
  std::unique_ptr<WallReport> report = localization.take_walls();
  localization.request_walls();
  if (!report || map == nullptr || report->map_hash != map->plan().hash) return nullptr;
  // Chosen among several.
  if (hash_ != report->map_hash) load(report->map_hash, map->plan().walls.size());
  walls_ = report->walls;
  update(hash_, walls_);
  return report;
}

core::LearnedWalls LearnedWallsFile::load(const std::string& map_hash, std::size_t walls) {
  hash_ = map_hash;
  written_ = {};
  if (folder_.empty() || map_hash.empty()) return {};
  const std::filesystem::path file = folder_ / settings::learned_walls_name(map_hash);
  std::error_code unread;
  if (std::filesystem::status(file, unread).type() == std::filesystem::file_type::not_found) {
    return {};
  }
  try {
    settings::LearnedWallsOfMap found = settings::parse_learned_walls(
        settings::read_file(file, settings::kMaxLearnedWallsBytes, settings::FileKind::kOrdinary),
        file);
    const auto is_unknown = [&](const core::WallOffset& one) { return one.wall >= walls; };
    if (found.map_hash != map_hash || std::ranges::any_of(found.walls.offsets, is_unknown)) {
      throw settings::SettingsError(file.string(), "", "is of another map");
    }
    written_ = std::move(found.walls);
    log(LogLevel::kInfo, file.string() + ": offsets of " + std::to_string(written_.offsets.size()) +
                             " walls are known");
  } catch (const std::exception& error) {
    problem_ = std::string("what was learned of the walls is not used: ") + error.what();
    log(LogLevel::kWarning, problem_);
  }
  return written_;
}

bool LearnedWallsFile::is_significant(const core::LearnedWalls& walls) const {
  if (walls.offsets.size() != written_.offsets.size()) return true;
  for (std::size_t k = 0; k < walls.offsets.size(); ++k) {
    const core::WallOffset& now = walls.offsets[k];
    const core::WallOffset& then = written_.offsets[k];
    if (now.wall != then.wall || now.sigma_m < kWorthRatio * then.sigma_m ||
        std::abs(now.offset_m - then.offset_m) > kWorthSigmas * now.sigma_m) {
      return true;
    }
  }
  return false;
}

void LearnedWallsFile::update(const std::string& map_hash, const core::LearnedWalls& walls) {
  if (folder_.empty() || map_hash.empty() || map_hash != hash_) return;
  if (walls.offsets.empty() || !is_significant(walls)) return;
  try {
    replace_file(folder_ / settings::learned_walls_name(map_hash),
                 settings::text_of({map_hash, walls}));
    written_ = walls;
    problem_.clear();
  } catch (const std::exception& error) {
    const std::string problem = std::string("cannot store what was learned of the walls: ") +
                                error.what() + "; set another /advanced/localizer/walls_folder";
    if (problem != std::exchange(problem_, problem)) log(LogLevel::kWarning, problem);
  }
}

}  // namespace cornerd::daemon
