// SPDX-License-Identifier: MIT
// Writes the protocol's messages (README.md) as lines of JSON, without a heap allocation.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "core/breakpoint/breakpoint.hpp"
#include "core/latency_histogram.hpp"
#include "core/odometry/odometry_frame.hpp"
#include "core/odometry/odometry_reading.hpp"
#include "core/odometry/odometry_summary.hpp"
#include "core/pose_estimate.hpp"
#include "message/json_text.hpp"

namespace cornerd::core {
struct Detection;
struct FloorPlan;
struct EstimatedBias;
class Scan;
}  // namespace cornerd::core

namespace cornerd::message {

/// Version of the protocol. It grows when a field is renamed or changes its meaning.
inline constexpr int kSchema = 2;

/// The contents of STATUS. Texts must outlive LineWriter::status(). Empty texts are left out.
struct StatusFields {
  core::TimeNs t_ns = 0;
  std::span<const std::string_view> faults;  ///< in the order of weight; left out if empty
  std::string_view hint;                     ///< of the first
  std::string_view lidar_state;
  std::string_view lidar_fault;
  std::string_view lidar_detail;
  std::string_view lidar_model;
  std::string_view lidar_firmware;
  std::string_view lidar_serial;
  std::string_view lidar_health;
  std::string_view lidar_mode;
  double rate_hz = 0;
  double samples_hz = 0;
  struct Mount {
    core::Pose2 T_base_lidar;
    bool inverted = false;  ///< the lidar hangs upside down; SCAN's angles have it already
    struct Estimate {
      core::Pose2 T_base_lidar;
      core::Pose2 sigma;
    };
    std::optional<Estimate> estimated{};  ///< by wheels and lidar
  };
  std::optional<Mount> mount;                 ///< left out where it is not known
  const core::EstimatedBias* bias = nullptr;  ///< of the lidar; left out before its first scan
  /// Learned offsets of the map's walls; left out where nothing is learned.
  struct Walls {
    std::size_t learned = 0;
    double sigma_m = 0;   ///< median
    double offset_m = 0;  ///< the largest, without its sign
  };
  Walls walls;
  /// Which of several maps the robot is in; left out where there is one.
  struct Map {
    std::string_view state;
    std::string_view name;                    ///< where it is known
    std::span<const std::string> candidates;  ///< where it is not
  };
  std::optional<Map> map;
  std::size_t walls_gone = 0;  ///< and things that stay and are not in the map
  std::size_t new_things = 0;
  struct Counter {
    std::string_view name;
    std::uint64_t value = 0;
  };
  std::span<const Counter> counters;
  /// Left out if odometry is disabled and there are no sensors.
  const core::OdometrySummary* odometry = nullptr;
  /// A device of /odometry/source "kernel".
  struct Sensor {
    std::string_view name;
    std::string_view state;
    std::string_view detail;
  };
  std::span<const Sensor> odometry_sensors;
  std::span<const Counter> odometry_counters;  ///< of the sensors
  std::string_view odometry_hint;
  std::string_view odometry_fault = "odometry-absent";  ///< which the hint is about
  std::span<const Counter> odometry_refusals;  ///< ODOMETRY lines that could not be read, by cause
  /// ODOMETRY lines rejected because another client publishes the same quantity.
  std::optional<std::uint64_t> second_client;
  /// From a scan's last sample to its pose, seconds.
  struct {
    double p50_s = 0;
    double p95_s = 0;
    double p99_s = 0;
    bool valid = false;
  } latency;
  /// One thread of the program.
  struct Loop {
    std::string_view name;
    const core::LatencyHistogram* latency = nullptr;
    std::optional<std::uint64_t> page_faults;
  };
  std::span<const Loop> loops;  ///< if empty, "realtime" is left out
  int realtime_priority = 0;
  bool memory_is_locked = false;
};

/// Writes one line at a time. The constructor reserves memory for the longest SCAN, so writing
/// allocates nothing (tests/unit/message/line_allocation_test.cpp). Every line ends with a newline
/// and is valid until the next call. Non-finite values are left out. Not thread-safe.
class LineWriter {
 public:
  LineWriter();

  std::string_view version(std::string_view program, std::string_view version);
  /// `plan`: gives the room its name; null where the map is not known. `map_names`: of the maps
  /// that it is one of; where there are, POSE and its alternatives have a map's name too.
  std::string_view pose(const core::PoseEstimate& pose, const core::FloorPlan* plan,
                        std::span<const std::string> map_names = {});
  std::string_view scan(const core::Scan& scan);
  std::string_view breakpoints(core::TimeNs t_ns, const core::Detection& detection);
  std::string_view status(const StatusFields& status);
  /// Allocates where the map is larger than the longest SCAN.
  std::string_view map(const core::FloorPlan& plan);
  std::string_view event(core::TimeNs t_ns, std::string_view what, std::string_view detail);
  /// `id_json`: the request's id as JSON text; empty if it had none.
  std::string_view ok(std::string_view request, std::string_view id_json);
  std::string_view error(std::string_view code, std::string_view text, std::string_view request,
                         std::string_view id_json);
  enum class Direction : std::uint8_t { kRx, kTx };
  std::string_view serial(core::TimeNs t_ns, Direction direction,
                          std::span<const std::uint8_t> bytes);
  std::string_view odometry(const core::OdometryReading& reading);
  std::string_view odom(const core::OdometryPose& pose);
  /// A line of a --truth file.
  std::string_view truth(core::TimeNs t_ns, const core::Pose2& T_map_base);

 private:
  void begin(std::string_view message_class);
  std::string_view finish();
  void id(std::string_view id_json);

  JsonText json_;
};

std::string_view to_string(core::PoseState state);
std::string_view to_string(core::BreakpointKind kind);

}  // namespace cornerd::message
