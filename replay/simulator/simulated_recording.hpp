// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <memory>
#include <optional>

#include "core/map/wall_map.hpp"
#include "replay/recording_writer.hpp"
#include "replay/simulator/motion.hpp"
#include "replay/simulator/simulated_odometry.hpp"
#include "replay/simulator/simulator.hpp"

namespace cornerd::replay {

struct SimulatedRecordingConfig {
  SimulatorConfig simulator;
  core::Pose2 T_base_lidar;
  std::int64_t scans = 10;          ///< whole turns in the recording
  double byte_fault_share = 0;      ///< bytes lost or damaged on the way (ByteFaults)
  double arrival_jitter_s = 1e-3;   ///< a read is late by up to this, evenly
  bool with_descriptor = true;      ///< begin with the response descriptor
  std::optional<RobotModel> robot;  ///< what tells the ODOMETRY lines; without it there are none
  /// Something hangs over the lidar for this time: nothing returns.
  core::TimeNs covered_from_ns = 0;
  core::TimeNs covered_to_ns = 0;
};

struct SimulatedRecordingSummary {
  std::uint64_t bytes = 0;
  std::uint64_t byte_faults = 0;
  std::uint64_t samples = 0;
  std::uint64_t returns = 0;  ///< samples with a distance
  double duration_s = 0;
};

/// Writes the recording of a robot with an A1 in a map: turns 0 to `turns` - 1 are whole, a part of
/// a turn stands before and after them. `truth` may be null; it gets the pose of `base` at every
/// change of place and every 10 ms of a drive. Time runs from 0.
/// Throws RecordingError where a file cannot be written, std::invalid_argument for a bad config.
SimulatedRecordingSummary simulate_recording(std::shared_ptr<const core::WallMap> map,
                                             const Motion& motion,
                                             const SimulatedRecordingConfig& config,
                                             RecordingWriter& recording, TruthWriter* truth);

}  // namespace cornerd::replay
