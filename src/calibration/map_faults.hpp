// SPDX-License-Identifier: MIT
// What is wrong with a map in which hardly any scan has a pose: its variants are tried.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/localizer_config.hpp"
#include "core/map/wall_map.hpp"
#include "core/scan.hpp"

namespace cornerd::calibration {

enum class MapFault : std::uint8_t {
  kMirrored,  ///< or the lidar hangs upside down, or does not
  kScale,     ///< of the map or one of its axes, or of the lidar where it is small
  kUnits,     ///< millimetres, centimetres, feet, inches
  kOtherMap,  ///< one of the config's
  kNoVariant  ///< none fits
};

struct MapFinding {
  MapFault fault = MapFault::kNoVariant;
  core::Vec2 scale = core::Vec2::Ones();  ///< true length over length in the map, along x and y
  std::string map{};                      ///< kOtherMap: its name
};

/// "map-mirrored" ...
std::string_view name_of(const MapFinding& finding);
/// What is wrong with the map `name`, and what to do.
std::string describe(const MapFinding& finding, const std::string& name);

using ScanSamples = std::vector<core::Sample>;

/// The newest scans, a second apart, to be examined.
class RecentScans {
 public:
  /// True if it is kept.
  bool add(const core::Scan& scan);
  bool are_enough() const;
  std::vector<ScanSamples> all() const { return {scans_.begin(), scans_.end()}; }

 private:
  std::deque<ScanSamples> scans_;
  core::TimeNs newest_ns_ = 0;
};

/// Localizes each scan without a prior in variants of `plan`, and in `others`. Nullopt where the
/// map itself fits most of them, or `is_over` returns true. Takes seconds.
std::optional<MapFinding> find_map_fault(const core::FloorPlan& plan,
                                         std::span<const core::FloorPlan> others,
                                         const core::LocalizerConfig& config,
                                         std::span<const ScanSamples> scans,
                                         const std::function<bool()>& is_over);

}  // namespace cornerd::calibration
