// SPDX-License-Identifier: MIT
#include "gridmap/occupancy_grid.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

namespace cornerd::gridmap {
namespace {

Cell by_thresholds(double occupancy, const MapServerYaml& yaml, bool graded) {
  if (occupancy > yaml.occupied_threshold) return Cell::kOccupied;
  if (occupancy < yaml.free_threshold) return Cell::kFree;
  if (!graded) return Cell::kUnknown;
  const double middle = (yaml.occupied_threshold + yaml.free_threshold) / 2;
  return occupancy >= middle ? Cell::kOccupied : Cell::kFree;
}

Cell read_shade(double shade, const MapServerYaml& yaml, bool graded) {
  if (yaml.negate) shade = 1 - shade;
  if (yaml.mode == ShadeMode::kRaw) {
    const double per_cent = std::round(255 * shade);
    return per_cent > 100 ? Cell::kUnknown : by_thresholds(per_cent / 100, yaml, false);
  }
  return by_thresholds(1 - shade, yaml, graded);
}

/// The shades between the thresholds. Where they are few, they mean unknown. Where they are many,
/// the picture is graded: a mapper's probabilities, or a drawing with soft edges. Then only a shade
/// of more than half of these pixels means unknown.
struct ShadesBetween {
  std::map<unsigned, std::size_t> pixels;  ///< of each shade
  std::optional<unsigned> unknown = std::nullopt;

  ShadesBetween(const Image& image, const MapServerYaml& yaml) {
    std::size_t all = 0;
    for (const unsigned shade : image.shades) {
      if (read_shade(shade / static_cast<double>(image.white), yaml, false) != Cell::kUnknown) {
        continue;
      }
      ++pixels[shade];
      ++all;
    }
    for (const auto& [shade, count] : pixels) {
      if (2 * count > all) unknown = shade;
    }
  }
  bool are_many() const { return pixels.size() >= kManyShades; }

 private:
  static constexpr std::size_t kManyShades = 8;
};

/// map_saver writes 0, 254, and 205 for unknown, whatever thresholds it writes
/// (nav2_map_server/src/map_io.cpp). By its own default of free_thresh, 0.25, 205 would be free.
constexpr unsigned kSavedUnknown = 205;
constexpr unsigned kSavedFree = 254;
/// One pixel in so many may have another shade: the edges of a brush that corrected the map.
constexpr std::size_t kCorrected = 100;

bool is_saved_by_ros(const Image& image, const MapServerYaml& yaml) {
  if (yaml.mode != ShadeMode::kTrinary || yaml.negate || image.white != 255) return false;
  std::size_t free = 0;
  std::size_t other = 0;
  for (const unsigned shade : image.shades) {
    if (shade == kSavedFree) ++free;
    if (shade != 0 && shade != kSavedUnknown && shade < kSavedFree) ++other;
  }
  return free > 0 && kCorrected * other <= image.shades.size();
}

}  // namespace

std::size_t OccupancyGrid::count(Cell kind) const {
  return static_cast<std::size_t>(std::count(cells_.begin(), cells_.end(), kind));
}

Cell OccupancyGrid::at(const core::Vec2& point) const {
  return at(static_cast<std::int64_t>(std::floor(point.x())),
            static_cast<std::int64_t>(std::floor(point.y())));
}

OccupancyGrid read_shades(const Image& image, const MapServerYaml& yaml) {
  OccupancyGrid grid(image.width, image.height);
  const double white = image.white;
  const bool is_saved = is_saved_by_ros(image, yaml);
  const ShadesBetween between(image, yaml);
  const bool is_graded = yaml.mode == ShadeMode::kScale ||
                         (yaml.mode == ShadeMode::kTrinary && !is_saved && between.are_many());
  for (std::size_t line = 0; line < image.height; ++line) {
    for (std::size_t column = 0; column < image.width; ++column) {
      const std::size_t i = line * image.width + column;
      if (!image.alphas.empty() && image.alphas[i] != 255) continue;
      if (is_saved && image.shades[i] == kSavedUnknown) continue;
      if (yaml.mode == ShadeMode::kTrinary && image.shades[i] == between.unknown) continue;
      grid.set(static_cast<std::int64_t>(column), grid.rows() - 1 - static_cast<std::int64_t>(line),
               read_shade(image.shades[i] / white, yaml, is_graded));
    }
  }
  return grid;
}

}  // namespace cornerd::gridmap
