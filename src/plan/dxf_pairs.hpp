// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <string>
#include <string_view>

namespace cornerd::plan {

/// The part of an ASCII DXF that describes walls, as dxflib can read it without harm: the library
/// reserves memory by counts that the file states, for lines of at most a thousand characters.
struct WallEntities {
  std::string text;
  std::map<std::string, std::size_t> ignored;  ///< kinds of entities that are left out
};

/// Keeps the header, and of blocks and entities the kinds that read_dxf() names, without those on
/// paper. Throws PlanError where it is no ASCII DXF.
WallEntities keep_wall_entities(std::string_view text);

}  // namespace cornerd::plan
