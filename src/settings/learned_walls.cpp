// SPDX-License-Identifier: MIT
#include "settings/learned_walls.hpp"

#include <algorithm>
#include <cmath>

#include <nlohmann/json.hpp>

#include "settings/object_reader.hpp"

namespace cornerd::settings {
namespace {

constexpr std::string_view kWallsFormat = "cornerd-walls";
constexpr std::size_t kHashDigits = 64;
constexpr std::size_t kNameDigits = 16;
constexpr std::size_t kMostWalls = core::WallOffsetFilter::kMaxWalls;
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
    if (!object.integer("wall", index, 0U, 1'000'000U)) object.fail("wall", "is missing");
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
  root.finish();
  return learned;
}

std::string text_of(const LearnedWallsOfMap& learned) {
  Json walls = Json::array();
  for (const core::WallOffset& wall : learned.walls.offsets) {
    walls.push_back({{"wall", wall.wall}, {"offset", wall.offset_m}});
  }
  const nlohmann::ordered_json document = {{"format", kWallsFormat},
                                           {"map", learned.map_hash},
                                           {"walls", walls},
                                           {"covariance", learned.walls.covariance_m2}};
  return document.dump() + '\n';
}

}  // namespace cornerd::settings
