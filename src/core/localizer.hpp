// SPDX-License-Identifier: MIT
// THE FILE TO READ FIRST, with localizer.cpp: one turn of the lidar in, one pose out.
#pragma once

#include <memory>
#include <optional>

#include "core/localizer_config.hpp"
#include "core/map/wall_map.hpp"
#include "core/odometry/odometry_reading.hpp"
#include "core/scan.hpp"
#include "core/scan_result.hpp"

namespace cornerd::core {

/// Finds the robot in a map, turn by turn. All memory is taken at construction: step() allocates
/// nothing, takes no lock, does no I/O (tests/unit/core/localizer_allocation_test.cpp counts).
/// Not safe for concurrent calls.
class Localizer {
 public:
  /// Without a map it detects breakpoints and is always lost.
  Localizer(std::shared_ptr<const WallMap> map, const LocalizerConfig& config);
  ~Localizer();
  Localizer(Localizer&&) noexcept;
  Localizer& operator=(Localizer&&) noexcept;

  /// Localizes in one complete turn. The result is valid until the next call.
  const ScanResult& step(const Scan& scan);

  /// What wheels and gyro say; before the turn that it belongs to. `now_ns`: see ReadingGate. Where
  /// odometry.publish is on and the last turn named a place: where the robot is by now, in the
  /// state predicted, valid until the next call; else null.
  const PoseEstimate* add(const OdometryReading& reading, std::optional<TimeNs> now_ns);

  /// The next sample of the turn in progress, after the turn that it ended. Where
  /// updates_per_scan asks for poses before the turn's end, and this sample ends a part of it that
  /// agrees with where the robot should be: where it is, at the time of the sample, in the state
  /// tracking, valid until the next call; else null.
  const PoseEstimate* follow(const Sample& sample);

  /// Somebody knows that the robot is about there, as of the last turn.
  void set_pose(const Pose2& T_map_base);

  /// Forgets where the robot was: the next turn is recognised without a prior.
  void relocalize();

  /// Forgets everything, what was learnt of the sensor included: as newly constructed.
  void forget();

  /// Another lidar: forgets how the last one erred and how noisy it was, not where the robot is.
  void forget_lidar();

  /// How the lidar errs always, as far as it is known by now.
  LearnedBias learned_bias() const;
  /// What was learnt of this lidar before.
  void resume(const LearnedBias& learned);

 private:
  struct Workspace;
  std::unique_ptr<Workspace> workspace_;
};

}  // namespace cornerd::core
