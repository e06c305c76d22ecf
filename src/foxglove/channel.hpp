// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace cornerd::foxglove {

/// What a message is published as, with its schema. The numbers are those of MCAP and of the
/// WebSocket; 0 is no channel.
enum class ChannelId : std::uint8_t {
  kScan = 1,  ///< foxglove.LaserScan
  kPose,      ///< foxglove.PoseInFrame
  kTransform,
  kWalls,  ///< foxglove.SceneUpdate
  // The daemon's own messages, as they are.
  kPoseMessage,
  kStatusMessage,
  kEventMessage,
  kOdometryMessage,
};

struct Channel {
  ChannelId id;
  std::string_view topic;
  std::string_view schema_name;
  std::string_view schema;  ///< JSON Schema
};

inline constexpr std::string_view kMessageEncoding = "json";
inline constexpr std::string_view kSchemaEncoding = "jsonschema";

/// In the order of their ids.
std::span<const Channel> channels();

}  // namespace cornerd::foxglove
