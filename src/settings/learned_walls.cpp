// SPDX-License-Identifier: MIT
#include "settings/learned_walls.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include <nlohmann/json.hpp>

#include "settings/object_reader.hpp"

namespace cornerd::settings {
namespace {

constexpr std::string_view kWallsFormat = "cornerd-walls";
constexpr std::size_t kHashDigits = 64;
constexpr std::uint32_t kMaxWallIndex = 1'000'000;
constexpr std::size_t kNameDigits = 16;
constexpr std::size_t kMostWalls = core::WallOffsetFilter::kMaxWalls;
/// Beyond any map.
constexpr double kFarthest_m = 1e6;
/// Farther off is another wall.
constexpr Interval kOffsetM{-0.5, 0.5};

const Json& require_list(ObjectReader& object, std::string_view key, std::size_t size_limit) {
  const Json* array = object.find(key);
  if (array == nullptr) object.fail(key, "is missing");
  if (!array->is_array() || array->size() > size_limit) {
    object.fail(key, "must be an array of at most " + std::to_string(size_limit));
  }
  return *array;
}

/// Changes of the map; a file of an earlier daemon has none.
void read_changes(ObjectReader& root, std::vector<core::MapChange>& changes) {
  using Kind = core::MapChange::Kind;
  const auto list = [&root](std::string_view key) {
    return root.find(key) == nullptr ? Json::array()
                                     : require_list(root, key, core::MapChanges::kMaxChanges);
  };
  const Json gone = list("gone");
  for (std::size_t i = 0; i < gone.size(); ++i) {
    if (!gone[i].is_number_unsigned() || gone[i].get<std::uint64_t>() > kMaxWallIndex) {
      root.fail("gone", i, "must be a wall's number");
    }
    changes.push_back({Kind::kWallGone, gone[i].get<std::uint32_t>(), core::Vec2::Zero()});
  }
  const Json added = list("new");
  for (std::size_t i = 0; i < added.size(); ++i) {
    const Json& at = added[i];
    const auto is_coordinate = [](const Json& value) {
      return value.is_number() && std::abs(value.get<double>()) < kFarthest_m;
    };
    if (!at.is_array() || at.size() != 2 || !is_coordinate(at[0]) || !is_coordinate(at[1])) {
      root.fail("new", i, "must be a place, [x, y]");
    }
    changes.push_back({Kind::kNewThing, 0, core::Vec2(at[0].get<double>(), at[1].get<double>())});
  }
}

}  // namespace

std::string learned_walls_name(std::string_view map_hash) {
  return "walls-" + std::string(map_hash.substr(0, kNameDigits)) + ".json";
}

LearnedWallsOfMap parse_learned_walls(std::string_view text, const std::filesystem::path& file) {
  const DocumentContext context{.file = file};
  const Json document = parse_document(text, file);
  ObjectReader root(context, document, "");
  std::string format;
  root.text("format", format, kHashDigits);
  if (format != kWallsFormat) root.fail("format", "must be \"" + std::string(kWallsFormat) + "\"");
  LearnedWallsOfMap learned;
  root.text("map", learned.map_hash, kHashDigits);
  const Json& walls = require_list(root, "walls", kMostWalls);
  for (std::size_t i = 0; i < walls.size(); ++i) {
    ObjectReader object = root.element("walls", walls, i);
    core::WallOffset wall;
    std::uint32_t index = 0;
    if (!object.integer("wall", index, 0U, kMaxWallIndex)) object.fail("wall", "is missing");
    wall.wall = index;
    object.number("offset", wall.offset_m, kOffsetM);
    object.finish();
    if (std::ranges::count(learned.walls.offsets, wall.wall, &core::WallOffset::wall) > 0) {
      object.fail("wall", "this wall is there twice");
    }
    learned.walls.offsets.push_back(wall);
  }
  const std::size_t size = walls.size();
  const Json& covariance = require_list(root, "covariance", kMostWalls * (kMostWalls + 1) / 2);
  if (covariance.size() != size * (size + 1) / 2) {
    root.fail("covariance", "must be the lower triangle of the walls' covariance, by rows");
  }
  for (std::size_t i = 0; i < covariance.size(); ++i) {
    if (!covariance[i].is_number()) root.fail("covariance", i, "must be a number");
    learned.walls.covariance_m2.push_back(covariance[i].get<double>());
  }
  for (std::size_t k = 0; k < size; ++k) {
    const double variance_m2 = learned.walls.covariance_m2[k * (k + 3) / 2];
    if (!(variance_m2 > 0)) root.fail("covariance", "a variance must be positive");
    learned.walls.offsets[k].sigma_m = std::sqrt(variance_m2);
  }
  read_changes(root, learned.changes);
  root.finish();
  return learned;
}

bool LearnedWallsOfMap::fits(std::size_t walls_of_map) const {
  return std::ranges::all_of(walls.offsets,
                             [&](const auto& one) { return one.wall < walls_of_map; }) &&
         std::ranges::all_of(changes, [&](const core::MapChange& change) {
           return change.kind != core::MapChange::Kind::kWallGone || change.wall < walls_of_map;
         });
}

std::string text_of(const LearnedWallsOfMap& learned) {
  Json walls = Json::array();
  for (const core::WallOffset& wall : learned.walls.offsets) {
    walls.push_back({{"wall", wall.wall}, {"offset", wall.offset_m}});
  }
  Json gone = Json::array();
  Json added = Json::array();
  for (const core::MapChange& change : learned.changes) {
    if (change.kind == core::MapChange::Kind::kWallGone) {
      gone.push_back(change.wall);
    } else {
      added.push_back({change.position.x(), change.position.y()});
    }
  }
  const nlohmann::ordered_json document = {
      {"format", kWallsFormat}, {"map", learned.map_hash},
      {"walls", walls},         {"gone", gone},
      {"new", added},           {"covariance", learned.walls.covariance_m2}};
  return document.dump() + '\n';
}

core::Vec2 place_of(const core::MapChange& change, const core::FloorPlan& plan) {
  if (change.kind != core::MapChange::Kind::kWallGone) return change.position;
  const core::Wall& wall = plan.walls[change.wall];
  return (wall.from + wall.to) / 2;
}

std::string describe(const core::MapChange& change, const core::FloorPlan& plan) {
  const bool is_gone = change.kind == core::MapChange::Kind::kWallGone;
  const core::Vec2 at = place_of(change, plan);
  const std::string subject = is_gone ? "wall " + std::to_string(change.wall) : "something new";
  std::array<char, 64> place{};
  std::snprintf(place.data(), place.size(), " at (%.2f, %.2f) ", at.x(), at.y());
  return subject + place.data() + (is_gone ? "is gone" : "stays");
}

}  // namespace cornerd::settings
