// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace cornerd::mqtt {

/// Of a fleet's map. A wrong one of this size takes 80 MB while it is checked, of the 128 MB of the
/// service.
inline constexpr std::size_t kMaxFleetMapBytes = 2 * 1024 * 1024;

/// The newest version of a map of a site: `cornerd/SITE/map/MAP`, retained. The file's bytes are
/// retained below it, at a topic that names their SHA-256, so that they never belong to another
/// announcement.
struct MapAnnouncement {
  std::string map;
  std::uint64_t version = 0;  ///< grows
  std::string sha256;         ///< 64 hexadecimal digits, lower case
  std::size_t bytes = 0;
};

std::string map_topic(const std::string& site, const std::string& map);
std::string map_file_topic(const std::string& site, const MapAnnouncement& announcement);

std::string map_announcement_json(const MapAnnouncement& announcement);
/// nullopt if it is none. Never throws.
std::optional<MapAnnouncement> parse_map_announcement(std::string_view payload);

}  // namespace cornerd::mqtt
