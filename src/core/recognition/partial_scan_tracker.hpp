// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "core/breakpoint/breakpoint_stream.hpp"
#include "core/estimate/refinement.hpp"
#include "core/localizer_config.hpp"
#include "core/map/ray_caster.hpp"
#include "core/map/wall_map.hpp"
#include "core/polar_scan.hpp"
#include "core/recognition/beam_model.hpp"
#include "core/scan.hpp"

namespace cornerd::core {

/// Predicted state of the lidar before a partial scan is matched.
struct PredictedState {
  Pose2 T_map_lidar;
  Covariance3 covariance = Covariance3::Identity();
  Twist2 motion;            ///< of the lidar, in its own axes
  double motion_age_s = 0;  ///< age of that velocity
};

/// Pose at the time of the partial scan's last sample.
struct PartialScanPose {
  RefinedPose refined;
  BeamCounts rays;
};

/// Localizes by partial scans while a revolution goes on: the predicted state and the part's wall
/// points give a pose before the scan ends (partial_scan_tracker_test.cpp; `cornerd-bench
/// localizer`, "quarters of a scan"). Allocates nothing after construction.
class PartialScanTracker {
 public:
  PartialScanTracker(const WallMap& map, const LocalizerConfig& config);

  /// Adds a sample. True where it ends a part other than the scan's last. Parts are fractions of
  /// the previous scan's number of samples: the first scan has none.
  bool add(const Sample& sample);

  TimeNs end_ns() const { return part_.end_ns(); }
  double duration_s() const { return to_seconds(part_.end_ns() - part_.start_ns()); }

  /// Pose of the part that has just ended; nullopt where it is inconsistent with the prediction.
  std::optional<PartialScanPose> localize(const PredictedState& predicted, const SensorBias& bias,
                                          double noise_scale);

  /// Breakpoints that became final in this part.
  std::span<const Breakpoint> breakpoints() const { return breakpoints_; }

 private:
  void begin_scan();

  const WallMap& map_;
  double min_range_m_;
  double max_range_m_;
  std::size_t parts_;
  RayCaster ray_caster_;
  Refinement refinement_;
  BeamModel beam_model_;
  BreakpointStream stream_;
  std::vector<Breakpoint> breakpoints_;
  Scan part_;
  PolarScan points_;
  bool part_has_ended_ = false;
  std::size_t completed_parts_ = 0;   ///< parts of this scan
  std::size_t samples_ = 0;           ///< of this scan
  std::size_t expected_samples_ = 0;  ///< samples of the previous scan; 0: unknown
  double swept_rad_ = 0;              ///< by this scan, counter-clockwise
  double last_bearing_rad_ = 0;
  bool has_start_ = false;  ///< this scan was received from its start
};

}  // namespace cornerd::core
