// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <bitset>
#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
#include <string>

#include "core/map/wall_map.hpp"
#include "daemon/latency_window.hpp"
#include "daemon/localization.hpp"
#include "daemon/message_server.hpp"
#include "daemon/rate_limited_log.hpp"
#include "message/line_writer.hpp"

namespace cornerd::daemon {

/// Publishes POSE, SCAN, BREAKPOINTS and EVENT from the results of scans, ODOM and ODOMETRY.
class ScanPublisher {
 public:
  /// About 15 s of an A1.
  static constexpr std::size_t kRecentScans = 100;
  static constexpr std::size_t kStates = static_cast<std::size_t>(core::PoseState::kLost) + 1;

  /// A map with its MAP. `has_name`: POSE names it, because there are several.
  struct PublishedMap {
    std::shared_ptr<const core::WallMap> map;
    Line line = nullptr;
    bool has_name = false;
  };

  ScanPublisher(MessageServer& server, PublishedMap map);

  void publish(const ScanReport& report);
  /// The map of scans from `generation` on; its MAP is published before the first POSE in it.
  void set_next_map(std::uint32_t generation, PublishedMap map);
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
  /// How many of the last kRecentScans in this map were lost.
  std::size_t recently_lost() const { return recent_lost_.count(); }
  /// Of the last POSE; null if there is none.
  const core::WallMap* map() const { return map_.map.get(); }

 private:
  void take_next_maps(std::uint32_t generation);
  void publish_pose(const core::PoseEstimate& pose);
  void publish_change(core::PoseState to, core::TimeNs t_ns);
  void publish_jump(const core::PoseEstimate& pose, std::uint64_t number);

  MessageServer& server_;
  PublishedMap map_;
  struct NextMap {
    std::uint32_t generation = 0;
    PublishedMap map;
  };
  std::deque<NextMap> next_maps_;  ///< in the order of their generations
  struct Fix {
    std::uint64_t number = 0;
    core::Pose2 T_map_base;
  };
  std::optional<Fix> last_fix_;
  message::LineWriter line_;
  RateLimitedLog jumps_{LogLevel::kInfo, "jump"};
  LatencyWindow latencies_;
  std::optional<core::PoseState> state_;
  core::OdometrySummary odometry_;
  core::EstimatedBias bias_;
  std::uint32_t lidar_ = 0;
  core::TimeNs end_ns_ = 0;
  std::array<std::uint64_t, kStates> poses_{};
  std::bitset<kRecentScans> recent_lost_;  ///< newest first
};

}  // namespace cornerd::daemon
