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
  const core::FloorPlan& plan = map.plan();
  if (known_.map_hash != plan.hash) known_ = load(plan.hash, plan.walls.size());
  localizer.resume(known_.walls, known_.changes);
}

std::unique_ptr<WallReport> LearnedWallsFile::update(Localization& localization,
                                                     const core::WallMap* map) {
  std::unique_ptr<WallReport> report = localization.take_walls();
  localization.request_walls();
  if (!report || map == nullptr || report->map_hash != map->plan().hash) return nullptr;
  // Chosen among several.
  if (known_.map_hash != report->map_hash) load(report->map_hash, map->plan().walls.size());
  known_ = *report;
  update(known_);
  return report;
}

WallReport LearnedWallsFile::load(const std::string& map_hash, std::size_t walls) {
  written_ = {.map_hash = map_hash, .walls = {}, .changes = {}};
  if (folder_.empty() || map_hash.empty()) return written_;
  const std::filesystem::path file = folder_ / settings::learned_walls_name(map_hash);
  std::error_code unread;
  if (std::filesystem::status(file, unread).type() == std::filesystem::file_type::not_found) {
    return written_;
  }
  try {
    WallReport found = settings::parse_learned_walls(
        settings::read_file(file, settings::kMaxLearnedWallsBytes, settings::FileKind::kOrdinary),
        file);
    if (found.map_hash != map_hash || !found.fits(walls)) {
      throw settings::SettingsError(file.string(), "", "is of another map");
    }
    written_ = std::move(found);
    log(LogLevel::kInfo, file.string() + ": offsets of " +
                             std::to_string(written_.walls.offsets.size()) + " walls are known");
  } catch (const std::exception& error) {
    problem_ = std::string("what was learned of the walls is not used: ") + error.what();
    log(LogLevel::kWarning, problem_);
  }
  return written_;
}

bool LearnedWallsFile::is_significant(const WallReport& learned) const {
  const auto is_close = [](const core::WallOffset& now, const core::WallOffset& then) {
    return now.wall == then.wall && now.sigma_m >= kWorthRatio * then.sigma_m &&
           std::abs(now.offset_m - then.offset_m) <= kWorthSigmas * now.sigma_m;
  };
  return !std::ranges::equal(learned.walls.offsets, written_.walls.offsets, is_close) ||
         learned.changes != written_.changes;
}

void LearnedWallsFile::update(const WallReport& learned) {
  const std::string& hash = learned.map_hash;
  if (folder_.empty() || hash.empty() || hash != written_.map_hash) return;
  // Nothing is learned where that is switched off: what was stays.
  if ((learned.walls.offsets.empty() && learned.changes.empty()) || !is_significant(learned)) {
    return;
  }
  try {
    replace_file(folder_ / settings::learned_walls_name(hash), settings::text_of(learned));
    written_ = learned;
    problem_.clear();
  } catch (const std::exception& error) {
    const std::string problem = std::string("cannot store what was learned of the walls: ") +
                                error.what() + "; set another /advanced/localizer/walls_folder";
    if (problem != std::exchange(problem_, problem)) log(LogLevel::kWarning, problem);
  }
}

}  // namespace cornerd::daemon
