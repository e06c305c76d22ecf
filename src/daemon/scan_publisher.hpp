// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <optional>
#include <string>
#include <vector>

#include "calibration/fault_list.hpp"
#include "core/map/wall_map.hpp"
#include "daemon/latency_window.hpp"
#include "daemon/localization.hpp"
#include "daemon/map_loader.hpp"
#include "daemon/message_server.hpp"
#include "daemon/pose_log.hpp"
#include "daemon/rate_limited_log.hpp"
#include "message/line_writer.hpp"

namespace cornerd::daemon {

/// Publishes POSE, SCAN, BREAKPOINTS and EVENT from the results of scans, ODOM and ODOMETRY.
class ScanPublisher {
 public:
  static constexpr std::size_t kStates = static_cast<std::size_t>(core::PoseState::kLost) + 1;

  /// Of a pipeline. `names`: POSE names its map, because there are several.
  struct PublishedMaps {
    std::vector<LoadedMap> maps;
    std::vector<std::string> names = {};
    calibration::RecentPoses::Limits limits = {};
  };

  ScanPublisher(MessageServer& server, PublishedMaps maps);

  void publish(const ScanReport& report);
  /// The maps of scans from `generation` on; MAP is published before the first POSE in it.
  void set_next_maps(std::uint32_t generation, PublishedMaps maps);
  /// Publishes MAP of the next map at once: no scan comes.
  void publish_next_map();
  /// ODOM of what waits; where nobody watches, the newest alone, for POLL. Call it ten times a
  /// second.
  void publish_odometry(Localization& localization);
  /// ODOMETRY of a reading, for recordings. `to_unix_ns`: added to its time.
  void publish(core::OdometryReading reading, core::TimeNs to_unix_ns);
  /// A pose between two scans; it does not change the state.
  void publish(const core::PoseEstimate& pose);

  const LatencyWindow& latencies() const { return latencies_; }
  /// State of the newest scan; nullopt before the first.
  std::optional<core::PoseState> state() const { return state_; }
  /// Of the newest scan.
  const core::OdometrySummary& odometry() const { return odometry_; }
  const core::EstimatedBias& bias() const { return bias_; }
  /// To which bias() belongs, see Localization::lidar().
  std::uint32_t lidar() const { return lidar_; }
  core::TimeNs end_of_newest_scan_ns() const { return end_ns_; }
  /// Number of scans by state.
  const std::array<std::uint64_t, kStates>& poses() const { return poses_; }
  /// In this map.
  const calibration::RecentPoses& recent() const { return recent_; }
  /// Of the last POSE; null where it is not known which of several.
  const core::WallMap* map() const { return map_ ? maps_.maps[*map_].map.get() : nullptr; }
  /// Which of several maps the robot is in; nullopt where there is one.
  std::optional<message::StatusFields::Map> choice() const;

 private:
  void take_next_maps(std::uint32_t generation);
  void use_map(std::optional<std::size_t> map, core::TimeNs t_ns);
  void publish_pose(const core::PoseEstimate& pose);
  void publish_change(core::PoseState to, core::TimeNs t_ns);
  void publish_jump(const core::PoseEstimate& pose, std::uint64_t number);

  MessageServer& server_;
  PublishedMaps maps_;
  std::optional<std::size_t> map_;       ///< of maps_; nullopt until it is known
  std::vector<std::string> candidates_;  ///< where it is not: those in doubt, of the last scan
  struct NextMaps {
    std::uint32_t generation = 0;
    PublishedMaps maps;
  };
  std::deque<NextMaps> next_maps_;  ///< in the order of their generations
  struct Fix {
    std::uint64_t number = 0;
    core::Pose2 T_map_base;
  };
  std::optional<Fix> last_fix_;
  message::LineWriter line_;
  PoseLog pose_log_;
  RateLimitedLog jumps_{LogLevel::kInfo, "jump"};
  LatencyWindow latencies_;
  std::optional<core::PoseState> state_;
  core::OdometrySummary odometry_;
  core::EstimatedBias bias_;
  std::uint32_t lidar_ = 0;
  core::TimeNs end_ns_ = 0;
  std::array<std::uint64_t, kStates> poses_{};
  calibration::RecentPoses recent_;
};

}  // namespace cornerd::daemon
