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
  std::int64_t scans = 10;          ///< complete scans in the recording
  double byte_fault_share = 0;      ///< see ByteFaults
  double arrival_jitter_s = 1e-3;   ///< delay of a read, uniform in [0, this]
  bool with_descriptor = true;      ///< begins with the response descriptor
  std::optional<RobotModel> robot;  ///< source of ODOMETRY lines; nullopt: none
  /// The lidar is covered in this interval: no returns.
  core::TimeNs covered_from_ns = 0;
  core::TimeNs covered_to_ns = 0;
};

struct SimulatedRecordingSummary {
  std::uint64_t bytes = 0;
  std::uint64_t byte_faults = 0;
  std::uint64_t samples = 0;
  std::uint64_t returns = 0;  ///< samples with a return
  double duration_s = 0;
};

/// Writes the recording of a robot with an A1 in a map: `config.scans` complete scans, with a
/// partial one before and after. `truth` may be null; it gets the pose of `base` at every jump and
/// every 10 ms of a drive. Time starts at 0. Throws RecordingError if a file cannot be written,
/// std::invalid_argument for a bad config.
SimulatedRecordingSummary simulate_recording(std::shared_ptr<const core::WallMap> map,
                                             const Motion& motion,
                                             const SimulatedRecordingConfig& config,
                                             RecordingWriter& recording, TruthWriter* truth);

}  // namespace cornerd::replay
