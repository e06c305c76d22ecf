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
#include "core/recognition/explanation.hpp"
#include "core/scan.hpp"

namespace cornerd::core {

/// What is known of the lidar before a part of a turn is looked at.
struct Expectation {
  Pose2 T_map_lidar;
  Covariance3 covariance = Covariance3::Identity();
  Twist2 motion;            ///< of the lidar, in its own axes
  double motion_age_s = 0;  ///< how long ago it moved so
};

/// The pose of a part of a turn: of the time of its last sample.
struct PartPose {
  RefinedPose refined;
  Explanation explanation;
};

/// Follows a robot whose place is known through a turn that is still going on. Part by part: what
/// was expected and the part's wall points together give a pose long before the turn ends
/// (part_tracker_test.cpp; `cornerctl bench --localizer`, "quarters of a turn"). All memory is
/// taken at construction.
class PartTracker {
 public:
  PartTracker(const WallMap& map, const LocalizerConfig& config);

  /// The next sample. True where it ends a part that is not the turn's last. Parts are as long as
  /// the turn before was: the first turn has none.
  bool add(const Sample& sample);

  TimeNs end_ns() const { return part_.end_ns(); }
  double duration_s() const { return to_seconds(part_.end_ns() - part_.start_ns()); }

  /// Of the part that has just ended. nullopt where it does not agree with what was expected: then
  /// the whole turn has to tell.
  std::optional<PartPose> localize(const Expectation& expected, const SensorBias& bias,
                                   double noise_scale);

  /// Those that became certain in this part.
  std::span<const Breakpoint> breakpoints() const { return breakpoints_; }

 private:
  void begin_scan();

  const WallMap& map_;
  double min_range_m_;
  double max_range_m_;
  SensorNoise noise_;
  std::size_t parts_;
  RayCaster prediction_;
  Refinement refinement_;
  BreakpointStream stream_;
  std::vector<Breakpoint> breakpoints_;
  Scan part_;
  PolarScan points_;
  bool part_has_ended_ = false;
  std::size_t ended_ = 0;    ///< parts of this turn
  std::size_t samples_ = 0;  ///< of this turn
  std::size_t usual_ = 0;    ///< samples of the turn before; 0: not known
  double swept_rad_ = 0;     ///< of this turn, counter-clockwise
  double last_bearing_rad_ = 0;
  bool whole_ = false;  ///< this turn was seen from its start
};

}  // namespace cornerd::core
