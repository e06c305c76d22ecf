// SPDX-License-Identifier: MIT
// What a client may send, and what a recording holds: one line in, one checked value out.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "core/geometry/pose2.hpp"
#include "core/odometry/odometry_reading.hpp"
#include "core/types.hpp"

namespace cornerd::message {

enum class MessageClass : std::uint8_t {
  kVersion,
  kPose,
  kScan,
  kBreakpoints,
  kOdometry,
  kStatus,
  kSerial,
  kEvent
};
std::string_view to_string(MessageClass message_class);
std::optional<MessageClass> message_class_from(std::string_view name);

/// A set of classes, as WATCH and --classes choose it.
class ClassSet {
 public:
  void insert(MessageClass c) { bits_ |= 1u << static_cast<unsigned>(c); }
  bool contains(MessageClass c) const { return bits_ >> static_cast<unsigned>(c) & 1u; }
  bool empty() const { return bits_ == 0; }

 private:
  std::uint32_t bits_ = 0;
};

struct WatchRequest {
  ClassSet classes;
};
struct PollRequest {};
struct RelocalizeRequest {};
struct SetPoseRequest {
  core::Pose2 T_map_base;
};
/// A request without t is one of now: `timed` is false and t_ns 0. A recorded one always has it.
struct OdometryReading : core::OdometryReading {
  bool timed = true;
};

struct RequestError {
  std::string code;  ///< "too-long", "json", "class", "field"
  std::string text;
};

struct Request {
  std::variant<RequestError, WatchRequest, PollRequest, RelocalizeRequest, SetPoseRequest,
               OdometryReading>
      body;
  std::string name;     ///< the class as sent; may be empty
  std::string id_json;  ///< JSON text; empty: none was sent
};

/// A longer line closes the connection of the client that sends it.
inline constexpr std::size_t kMaxRequestBytes = 64 * 1024;
/// Fits the longest SCAN, written with all the places that a double has.
inline constexpr std::size_t kMaxRecordedBytes = 2 * 1024 * 1024;

/// Never throws; any bytes give a Request, a bad line one that holds RequestError.
Request parse_request(std::string_view line);

/// The lines of a recording that are inputs; the rest is none of these.
/// A whole turn: its first sample starts it, its last one ends it.
struct RecordedScan {
  core::TimeNs t_ns = 0;
  core::TimeNs duration_ns = 0;
  std::vector<core::Sample> samples;
};
struct RecordedBytes {
  core::TimeNs t_ns = 0;
  bool received = true;  ///< rx; else tx
  std::vector<std::uint8_t> bytes;
};
struct RecordedTruth {
  core::TimeNs t_ns = 0;
  core::Pose2 T_map_base;
};
struct OtherLine {
  std::string name;
};
using RecordedLine =
    std::variant<RequestError, RecordedScan, RecordedBytes, OdometryReading, OtherLine>;

/// Never throws.
RecordedLine parse_recorded_line(std::string_view line);
std::variant<RequestError, RecordedTruth> parse_truth_line(std::string_view line);

}  // namespace cornerd::message
