// SPDX-License-Identifier: MIT
// The messages of CONTRACT as lines of JSON: written by hand, without a heap allocation.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include "core/lateness.hpp"
#include "core/odometry/odometry_summary.hpp"
#include "core/pose_estimate.hpp"
#include "message/json_text.hpp"

namespace cornerd::core {
struct Detection;
struct FloorPlan;
struct LearnedBias;
class Scan;
}  // namespace cornerd::core

namespace cornerd::message {

/// Version of the messages themselves: grows only where a field would change its meaning.
inline constexpr int kSchema = 1;

/// What STATUS says. Texts must outlive the call that writes them.
struct StatusFields {
  core::TimeNs t_ns = 0;
  std::string_view lidar_state;
  std::string_view lidar_fault;  ///< this and those below: left out where empty
  std::string_view lidar_detail;
  std::string_view lidar_model;
  std::string_view lidar_firmware;
  std::string_view lidar_serial;
  std::string_view lidar_health;
  std::string_view lidar_mode;
  double rate_hz = 0;
  double samples_hz = 0;
  const core::LearnedBias* bias = nullptr;  ///< of the lidar; left out where nothing is learnt
  struct Counter {
    std::string_view name;
    std::uint64_t value = 0;
  };
  std::span<const Counter> counters;
  const core::OdometrySummary* odometry =
      nullptr;  ///< left out where it is switched off and has no sensors, too
  /// The devices that odometry comes from; empty where they are not this program's.
  struct Sensor {
    std::string_view name;
    std::string_view state;
    std::string_view detail;  ///< left out where empty
  };
  std::span<const Sensor> odometry_sensors;
  std::span<const Counter> odometry_counters;  ///< of the devices
  std::string_view odometry_hint;              ///< what is wrong with it; left out where empty
  /// Lines that were refused as another client's come; left out where there are no clients.
  std::optional<std::uint64_t> second_client;
  /// From a turn's last sample to its pose, over the last turns; left out where there are none.
  struct {
    double p50_s = 0;
    double p95_s = 0;
    double p99_s = 0;
    bool valid = false;
  } latency;
  /// A loop of the program, and how late it came to its work.
  struct Loop {
    std::string_view name;
    const core::Lateness* lateness = nullptr;
    std::optional<std::uint64_t> page_faults;
  };
  std::span<const Loop> loops;  ///< with the two below left out where empty
  int realtime_priority = 0;
  bool memory_is_locked = false;
};

/// One line under construction. Memory for the longest SCAN is taken at construction; writing
/// allocates nothing (texts of reasonable length taken as given) and ends every message with a
/// newline. What is returned is valid until the next message. Values that are not finite are left
/// out. Not safe for concurrent calls.
class LineWriter {
 public:
  LineWriter();

  std::string_view version(std::string_view program, std::string_view version);
  /// `plan` names the room; may be null.
  std::string_view pose(const core::PoseEstimate& pose, const core::FloorPlan* plan);
  std::string_view scan(const core::Scan& scan);
  std::string_view breakpoints(core::TimeNs t_ns, const core::Detection& detection);
  std::string_view status(const StatusFields& status);
  std::string_view event(core::TimeNs t_ns, std::string_view what, std::string_view detail);
  /// `id_json`: the request's id as JSON text; empty: it had none.
  std::string_view ok(std::string_view request, std::string_view id_json);
  std::string_view error(std::string_view code, std::string_view text, std::string_view request,
                         std::string_view id_json);
  enum class Direction : std::uint8_t { kRx, kTx };
  std::string_view serial(core::TimeNs t_ns, Direction direction,
                          std::span<const std::uint8_t> bytes);
  struct OdometryFields {
    core::TimeNs t_ns = 0;
    bool has_counts = false;
    std::int64_t left = 0;
    std::int64_t right = 0;
    bool has_gyro = false;
    double gyro_rad_s = 0;
  };
  std::string_view odometry(const OdometryFields& odometry);
  /// A line of a --truth file.
  std::string_view truth(core::TimeNs t_ns, const core::Pose2& T_map_base);

 private:
  void begin(std::string_view message_class);
  std::string_view finish();
  void id(std::string_view id_json);

  JsonText json_;
};

}  // namespace cornerd::message
