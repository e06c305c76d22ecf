// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "core/localizer.hpp"
#include "core/map_filter.hpp"

namespace cornerd::core {

/// Localizes a lidar in the one of several maps (floors of a building, buildings of a site) that
/// its scans were taken in. Until that is known, a scan is kept and compared in one map after the
/// other, one for each scan that comes: a choice costs a comparison and a detection per scan, and
/// the memory of a localizer for each map. Then the map's localizer goes on. Allocates nothing
/// after construction. Not safe for concurrent calls.
class MapChoice {
 public:
  /// Maps that an ambiguous pose can name.
  static constexpr std::size_t kMaxMaps = kMaxAlternatives;

  /// A single map, which may be null, is known from the start. At most kMaxMaps.
  MapChoice(std::span<const std::shared_ptr<const WallMap>> maps, const LocalizerConfig& config);

  /// As Localizer::step(). Until the map is known the state is ambiguous, and each alternative is
  /// the pose in a map that is in doubt, at the time of the scan that was compared last; or lost,
  /// where it fits no map.
  const ScanResult& step(const Scan& scan);

  /// Which map the robot is in: an index into the constructor's; nullopt until it is known.
  std::optional<std::size_t> map() const { return map_; }
  /// Of that map; until it is known, one without a map.
  Localizer& localizer() { return map_ ? localizers_[*map_] : *without_map_; }
  /// Of all maps.
  std::span<Localizer> localizers() { return localizers_; }
  /// Continues from a stored estimate of this lidar's bias.
  void resume(const EstimatedBias& learned);
  /// Continues with what another pipeline has learned of the odometry: see Localizer.
  void resume_odometry(MapChoice& other);
  const MapFilter& filter() const { return filter_; }

  /// Forgets the pose, and the map where there are several.
  void relocalize();
  /// For another lidar: as Localizer::forget_lidar().
  void forget_lidar();

 private:
  /// One map more, for the scan that is kept.
  void compare(const Scan& scan);
  void report(PoseEstimate& pose) const;

  std::vector<Localizer> localizers_;
  std::optional<Localizer> without_map_;  ///< where there are several
  std::optional<std::size_t> map_;
  MapFilter filter_;
  std::vector<MapEvidence> evidence_;  ///< of the scan in comparison
  std::vector<MapEvidence> compared_;  ///< of the last one that was compared in all maps
  std::size_t next_ = 0;               ///< map of the comparison
  bool is_comparing_ = false;
  std::size_t steps_ = 0;  ///< with kept_ in the map next_
  Scan kept_;
  TimeNs compared_ns_ = 0;
  EstimatedBias bias_;  ///< that every comparison begins with
  ScanResult result_;
};

}  // namespace cornerd::core
