// SPDX-License-Identifier: MIT
// Start here, with localizer.cpp: one scan in, one pose out.
#pragma once

#include <memory>
#include <optional>
#include <span>

#include "core/estimate/map_changes.hpp"
#include "core/estimate/wall_offset_filter.hpp"
#include "core/localizer_config.hpp"
#include "core/map/wall_map.hpp"
#include "core/odometry/odometry_frame.hpp"
#include "core/odometry/odometry_reading.hpp"
#include "core/scan.hpp"
#include "core/scan_result.hpp"

namespace cornerd::core {

/// Localizes a lidar in a map, scan by scan. All memory is taken at construction: step() allocates
/// nothing, takes no lock and does no I/O (tests/unit/core/localizer_allocation_test.cpp). Not safe
/// for concurrent calls.
class Localizer {
 public:
  /// `map` may be null: breakpoints are detected and the state is always lost.
  Localizer(std::shared_ptr<const WallMap> map, const LocalizerConfig& config);
  ~Localizer();
  Localizer(Localizer&&) noexcept;
  Localizer& operator=(Localizer&&) noexcept;

  /// Localizes by one complete scan. The result is valid until the next call.
  const ScanResult& step(const Scan& scan);

  /// Adds a reading of wheels and gyro, before the scan that it belongs to. Returns the
  /// pose at the reading's time, state predicted, where odometry.publish_predictions is on and the
  /// last scan gave a pose; else null. Valid until the next call.
  const PoseEstimate* add(const OdometryReading& reading);

  /// Adds the next sample of the scan in progress. Returns the pose at the sample's time, state
  /// tracking, where the sample ends a partial scan (updates_per_scan) that is consistent with the
  /// predicted state; else null. Valid until the next call.
  const PoseEstimate* follow(const Sample& sample);

  /// Sets the initial pose, as of the last scan.
  void set_pose(const Pose2& T_map_base);

  /// Forgets the pose: the next scan is localized globally.
  void relocalize();

  /// Back to the state after construction, estimates of the sensor included.
  void forget();
  /// The same where the stream goes on: the next reading still tells of a motion.
  void forget_scans();

  /// For another lidar: forgets the estimated bias and noise, not the pose.
  void forget_lidar();

  /// Log odds, nats, that the last scan was taken at the likeliest of the places that step() has
  /// reported, against elsewhere or another map; nullopt where it was lost. Comparable between
  /// maps.
  std::optional<double> log_odds_of_map();

  /// True where the last scan has left a search of the map unfinished, which step() with the same
  /// scan goes on with: LocalizerConfig::search_nodes_per_scan.
  bool is_searching() const;

  /// What the last reading told of the motion before it, if it was taken.
  const std::optional<MeasuredMotion>& measured_motion() const;
  /// Null without a map.
  const WallMap* map() const;
  /// The current estimate of the lidar's bias.
  EstimatedBias estimated_bias() const;
  /// Continues from a stored estimate of this lidar's bias.
  void resume(const EstimatedBias& learned);

  /// What was learned of the walls' offsets; null without a map, or without learn_walls.
  const WallOffsetFilter* walls() const;
  /// Walls that are gone and things that stay, in this map; none where walls() is null.
  std::span<const MapChange> map_changes() const;
  /// Continues with what another localizer has learned of the odometry, from its readings on.
  /// Nothing where the mount or the robot of its config is another.
  void resume_odometry(const Localizer& other);
  /// Continues from what was learned of this map. False where it does not fit.
  bool resume(const LearnedWalls& learned, std::span<const MapChange> changes);

 private:
  struct Workspace;
  std::unique_ptr<Workspace> workspace_;
};

}  // namespace cornerd::core
