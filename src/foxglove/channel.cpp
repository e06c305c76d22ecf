// SPDX-License-Identifier: MIT
// Schemas: docs.foxglove.dev, "Foxglove schemas", the fields that are sent.
#include "foxglove/channel.hpp"

#include <array>

namespace cornerd::foxglove {

namespace {

std::string object(const std::string& properties) {
  return R"({"type":"object","properties":{)" + properties + "}}";
}
std::string field(const std::string& name, const std::string& schema) {
  return '"' + name + "\":" + schema;
}
std::string list(const std::string& schema) { return R"({"type":"array","items":)" + schema + '}'; }

const std::string kNumber = R"({"type":"number"})";
const std::string kInteger = R"({"type":"integer"})";
const std::string kString = R"({"type":"string"})";
const std::string kTime = object(field("sec", kInteger) + ',' + field("nsec", kInteger));

std::string numbers(const std::string& names) {
  std::string fields;
  for (const char name : names) {
    fields += (fields.empty() ? "" : ",") + field(std::string(1, name), kNumber);
  }
  return object(fields);
}

std::string pose() {
  return object(field("position", numbers("xyz")) + ',' + field("orientation", numbers("xyzw")));
}
std::string stamped(const std::string& fields) {
  return object(field("timestamp", kTime) + ',' + fields);
}

const std::string kScanSchema =
    stamped(field("frame_id", kString) + ',' + field("pose", pose()) + ',' +
            field("start_angle", kNumber) + ',' + field("end_angle", kNumber) + ',' +
            field("ranges", list(kNumber)) + ',' + field("intensities", list(kNumber)));
const std::string kPoseSchema = stamped(field("frame_id", kString) + ',' + field("pose", pose()));
const std::string kTransformSchema =
    stamped(field("parent_frame_id", kString) + ',' + field("child_frame_id", kString) + ',' +
            field("translation", numbers("xyz")) + ',' + field("rotation", numbers("xyzw")));
const std::string kCubeSchema = object(field("pose", pose()) + ',' + field("size", numbers("xyz")) +
                                       ',' + field("color", numbers("rgba")));
const std::string kWallsSchema = object(
    field("deletions", list(stamped(field("type", kInteger) + ',' + field("id", kString)))) + ',' +
    field("entities", list(stamped(field("frame_id", kString) + ',' + field("id", kString) + ',' +
                                   field("lifetime", kTime) + ',' +
                                   field("frame_locked", R"({"type":"boolean"})") + ',' +
                                   field("cubes", list(kCubeSchema))))));
constexpr std::string_view kOwnSchema = R"({"type":"object"})";

}  // namespace

std::span<const Channel> channels() {
  static const std::array<Channel, 8> kAll = {{
      {ChannelId::kScan, "/scan", "foxglove.LaserScan", kScanSchema},
      {ChannelId::kPose, "/pose", "foxglove.PoseInFrame", kPoseSchema},
      {ChannelId::kTransform, "/tf", "foxglove.FrameTransform", kTransformSchema},
      {ChannelId::kWalls, "/walls", "foxglove.SceneUpdate", kWallsSchema},
      {ChannelId::kPoseMessage, "/cornerd/pose", "cornerd.Pose", kOwnSchema},
      {ChannelId::kStatusMessage, "/cornerd/status", "cornerd.Status", kOwnSchema},
      {ChannelId::kEventMessage, "/cornerd/event", "cornerd.Event", kOwnSchema},
      {ChannelId::kOdometryMessage, "/cornerd/odometry", "cornerd.Odometry", kOwnSchema},
  }};
  return kAll;
}

}  // namespace cornerd::foxglove
