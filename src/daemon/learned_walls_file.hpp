// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <utility>

#include "core/estimate/wall_offset_filter.hpp"
#include "core/localizer.hpp"
#include "daemon/localization.hpp"
#include "settings/config.hpp"

namespace cornerd::daemon {

/// Folder of what was learned of walls: the configured one, or $STATE_DIRECTORY. Empty (no file)
/// without either, and for a recording.
std::filesystem::path learned_walls_folder(const settings::Config& config);

/// Keeps what was learned of each map's walls across restarts. Errors are logged once and otherwise
/// ignored. For the server thread.
class LearnedWallsFile {
 public:
  /// An empty `folder` stores nothing.
  explicit LearnedWallsFile(std::filesystem::path folder) : folder_(std::move(folder)) {}

  /// Continues the localizer, which is of this map, from what is known of its walls.
  void resume(core::Localizer& localizer, const core::WallMap& map);
  /// Asks for what the localizer has learned, and takes what came since the last call: null where
  /// that is nothing, or not of `map`, the last POSE's.
  std::unique_ptr<WallReport> update(Localization& localization, const core::WallMap* map);

  /// Why what is learned is not kept, or what was stored is not used; empty if nothing is wrong.
  const std::string& problem() const { return problem_; }

  /// What is stored for the map; nothing where there is none or it is of another map.
  WallReport load(const std::string& map_hash, std::size_t walls);
  /// Writes it if a wall has changed, or an offset by more than its uncertainty: a few dozen times
  /// while the robot sees the building for the first time, rarely later.
  void update(const WallReport& learned);

 private:
  bool is_significant(const WallReport& learned) const;

  std::filesystem::path folder_;
  WallReport known_;  ///< of the map in use, the newest
  WallReport written_;
  std::string problem_;
};

}  // namespace cornerd::daemon
