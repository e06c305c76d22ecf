// SPDX-License-Identifier: MIT
// Parses requests of clients and lines of recordings into checked values.
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
  kEvent,
  kMap,
  kOdom
};
inline constexpr std::size_t kMessageClasses = static_cast<std::size_t>(MessageClass::kOdom) + 1;
std::string_view to_string(MessageClass message_class);
std::optional<MessageClass> message_class_from(std::string_view name);
/// Of all classes, separated by commas.
std::string class_names();

/// A set of message classes.
class ClassSet {
 public:
  void insert(MessageClass c) { bits_ |= 1u << static_cast<unsigned>(c); }
  void erase(MessageClass c) { bits_ &= ~(1u << static_cast<unsigned>(c)); }
  bool contains(MessageClass c) const { return bits_ >> static_cast<unsigned>(c) & 1u; }
  bool empty() const { return bits_ == 0; }

 private:
  std::uint32_t bits_ = 0;
};

struct WatchRequest {
  ClassSet classes;
};
struct PollRequest {
  ClassSet classes;  ///< of those that kPolled names
};
/// One of the config's maps, or a file below their folders.
struct SetMapRequest {
  std::string name;  ///< empty where `file` is given
  std::string file;
};
struct RelocalizeRequest {};
struct SetPoseRequest {
  core::Pose2 T_map_base;
};
/// Without "t", `timed` is false and t_ns is 0. A recorded reading always has "t".
struct OdometryReading : core::OdometryReading {
  bool timed = true;
};

struct RequestError {
  std::string code;  ///< "too-long", "json", "class", "field"
  std::string text;
  std::string_view cause = {};  ///< of "field": one of FieldReader's
  std::string class_name = {};  ///< of a recorded line, where it has one
};

struct Request {
  std::variant<RequestError, WatchRequest, PollRequest, RelocalizeRequest, SetPoseRequest,
               SetMapRequest, OdometryReading>
      body;
  std::string name;     ///< the class as received; may be empty
  std::string id_json;  ///< JSON text; empty if absent
};

/// A client that sends a longer line is disconnected.
inline constexpr std::size_t kMaxRequestBytes = 64 * 1024;
/// Fits the longest SCAN with all digits of its doubles.
inline constexpr std::size_t kMaxRecordedBytes = 2 * 1024 * 1024;
/// Fits a MAP of 100,000 walls with all digits of its doubles.
inline constexpr std::size_t kMaxMessageBytes = 32 * 1024 * 1024;

/// The classes whose newest message POLL gives; without names it gives POSE and STATUS.
inline constexpr MessageClass kPolled[] = {MessageClass::kVersion, MessageClass::kPose,
                                           MessageClass::kStatus,  MessageClass::kEvent,
                                           MessageClass::kMap,     MessageClass::kOdom};

/// Never throws. A malformed line gives a Request that holds RequestError.
Request parse_request(std::string_view line);

/// A SCAN: its first sample starts the scan, its last sample ends it.
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
/// A message of another class; replay skips it.
struct OtherLine {
  std::string name;
};
using RecordedLine =
    std::variant<RequestError, RecordedScan, RecordedBytes, OdometryReading, OtherLine>;

/// Never throws.
RecordedLine parse_recorded_line(std::string_view line);
std::variant<RequestError, RecordedTruth> parse_truth_line(std::string_view line);

}  // namespace cornerd::message
