// SPDX-License-Identifier: MIT
#include "foxglove/converter.hpp"

#include <algorithm>
#include <cmath>
#include <variant>
#include <vector>

#include "message/request.hpp"

namespace cornerd::foxglove {

namespace {

using message::JsonText;

constexpr int kDecimals = 6;
/// How high walls are drawn.
constexpr double kWallHeight_m = 0.3;
/// A wall without a thickness is drawn too.
constexpr double kThinnestWall_m = 0.005;

void write_time(JsonText& json, std::string_view name, core::TimeNs t_ns) {
  // Whole seconds towards minus infinity: nsec is not negative.
  const core::TimeNs ns = (t_ns % core::kNsPerSecond + core::kNsPerSecond) % core::kNsPerSecond;
  json.open_object(name);
  json.integer("sec", (t_ns - ns) / core::kNsPerSecond);
  json.integer("nsec", ns);
  json.close_object();
}

void write_vector(JsonText& json, std::string_view name, double x, double y, double z) {
  json.open_object(name);
  json.number("x", x, kDecimals);
  json.number("y", y, kDecimals);
  json.number("z", z, kDecimals);
  json.close_object();
}

/// A rotation about z as a quaternion.
void write_rotation(JsonText& json, std::string_view name, double theta_rad) {
  json.open_object(name);
  json.integer("x", 0);
  json.integer("y", 0);
  json.number("z", std::sin(theta_rad / 2), kDecimals);
  json.number("w", std::cos(theta_rad / 2), kDecimals);
  json.close_object();
}

void write_pose(JsonText& json, const core::Pose2& pose, double z_m = 0) {
  json.open_object("pose");
  write_vector(json, "position", pose.x_m, pose.y_m, z_m);
  write_rotation(json, "orientation", pose.theta_rad);
  json.close_object();
}

void write_wall(JsonText& json, const core::Wall& wall) {
  const core::Vec2 along = wall.to - wall.from;
  const core::Vec2 middle = (wall.from + wall.to) / 2;
  const double thickness_m = std::max(wall.thickness_m, kThinnestWall_m);
  json.open_object();
  write_pose(json, {middle.x(), middle.y(), core::angle_of(along)}, kWallHeight_m / 2);
  write_vector(json, "size", along.norm() + thickness_m, thickness_m, kWallHeight_m);
  json.raw("color", R"({"r":0.5,"g":0.55,"b":0.62,"a":1})");
  json.close_object();
}

/// In ascending angle, from the end of the largest gap on.
std::vector<core::Sample> by_angle(std::vector<core::Sample> samples) {
  const auto angle = [](const core::Sample& sample) { return sample.bearing_rad; };
  std::sort(samples.begin(), samples.end(),
            [&](const auto& a, const auto& b) { return angle(a) < angle(b); });
  const auto full_turn = static_cast<float>(2 * core::kPi);
  std::size_t first = 0;
  float largest_gap_rad =
      samples.empty() ? 0 : angle(samples[0]) + full_turn - angle(samples.back());
  for (std::size_t i = 1; i < samples.size(); ++i) {
    const float gap_rad = angle(samples[i]) - angle(samples[i - 1]);
    if (gap_rad <= largest_gap_rad) continue;
    largest_gap_rad = gap_rad;
    first = i;
  }
  for (std::size_t i = 0; i < first; ++i) samples[i].bearing_rad += full_turn;
  std::rotate(samples.begin(), samples.begin() + static_cast<std::ptrdiff_t>(first), samples.end());
  return samples;
}

}  // namespace

Converter::Converter() : json_(64 * 1024) {}

std::string Converter::convert(std::string_view line, core::TimeNs now_ns, const Emit& emit) {
  const message::ParsedLine parsed = message::parse_line(line);
  if (const auto* damage = std::get_if<message::RequestError>(&parsed)) return damage->text;
  if (const auto* scanned = std::get_if<message::RecordedScan>(&parsed)) {
    scan(*scanned, emit);
  } else if (const auto* posed = std::get_if<message::ParsedPose>(&parsed)) {
    pose(*posed, line, emit);
  } else if (const auto* status = std::get_if<message::ParsedStatus>(&parsed)) {
    if (status->T_base_lidar) T_base_lidar_ = *status->T_base_lidar;
    emit(ChannelId::kStatusMessage, status->t_ns, line);
  } else if (const auto* event = std::get_if<message::ParsedEvent>(&parsed)) {
    emit(ChannelId::kEventMessage, event->t_ns, line);
  } else if (const auto* map = std::get_if<message::ParsedMap>(&parsed)) {
    walls(map->plan, now_ns, emit);
  } else if (const auto* other = std::get_if<message::OtherLine>(&parsed);
             other != nullptr && other->name == "ODOMETRY") {
    const message::RecordedLine recorded = message::parse_recorded_line(line);
    if (const auto* damage = std::get_if<message::RequestError>(&recorded)) return damage->text;
    const auto* reading = std::get_if<message::OdometryReading>(&recorded);
    if (reading != nullptr) emit(ChannelId::kOdometryMessage, reading->t_ns, line);
  }
  return {};
}

// Foxglove's LaserScan has its samples at equal angles. A lidar turns almost evenly: each of them
// is the sample next to it, half a step away at most where the samples are evenly spaced.
void Converter::scan(const message::RecordedScan& scan, const Emit& emit) {
  const std::vector<core::Sample> samples = by_angle(scan.samples);
  if (samples.empty()) return;
  const double first_rad = samples.front().bearing_rad;
  const double last_rad = samples.back().bearing_rad;
  const std::size_t count = samples.size();
  const double step_rad = count > 1 ? (last_rad - first_rad) / static_cast<double>(count - 1) : 0;
  std::vector<const core::Sample*> nearest(count);
  std::size_t at = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const double angle_rad = first_rad + static_cast<double>(i) * step_rad;
    while (at + 1 < count && std::abs(samples[at + 1].bearing_rad - angle_rad) <=
                                 std::abs(samples[at].bearing_rad - angle_rad)) {
      ++at;
    }
    nearest[i] = &samples[at];
  }
  json_.clear();
  json_.open_object();
  write_time(json_, "timestamp", scan.t_ns);
  json_.string("frame_id", "lidar");
  write_pose(json_, {});
  json_.number("start_angle", first_rad, kDecimals);
  json_.number("end_angle", last_rad, kDecimals);
  json_.open_array("ranges");
  for (const core::Sample* sample : nearest) json_.fixed(sample->range_m, 4);
  json_.close_array();
  json_.open_array("intensities");
  for (const core::Sample* sample : nearest) json_.integer(static_cast<int>(sample->quality));
  json_.close_array();
  json_.close_object();
  emit(ChannelId::kScan, scan.t_ns, json_.view());
}

void Converter::pose(const message::ParsedPose& pose, std::string_view line, const Emit& emit) {
  emit(ChannelId::kPoseMessage, pose.t_ns, line);
  // Repeated, since a client may come at any time.
  transform(pose.t_ns, "base", "lidar", T_base_lidar_, emit);
  if (!pose.T_map_base) return;
  transform(pose.t_ns, "map", "base", *pose.T_map_base, emit);
  json_.clear();
  json_.open_object();
  write_time(json_, "timestamp", pose.t_ns);
  json_.string("frame_id", "map");
  write_pose(json_, *pose.T_map_base);
  json_.close_object();
  emit(ChannelId::kPose, pose.t_ns, json_.view());
}

void Converter::transform(core::TimeNs t_ns, std::string_view parent, std::string_view child,
                          const core::Pose2& T_parent_child, const Emit& emit) {
  json_.clear();
  json_.open_object();
  write_time(json_, "timestamp", t_ns);
  json_.string("parent_frame_id", parent);
  json_.string("child_frame_id", child);
  write_vector(json_, "translation", T_parent_child.x_m, T_parent_child.y_m, 0);
  write_rotation(json_, "rotation", T_parent_child.theta_rad);
  json_.close_object();
  emit(ChannelId::kTransform, t_ns, json_.view());
}

void Converter::walls(const core::FloorPlan& plan, core::TimeNs t_ns, const Emit& emit) {
  json_.clear();
  json_.open_object();
  json_.open_array("deletions");
  json_.close_array();
  json_.open_array("entities");
  json_.open_object();
  write_time(json_, "timestamp", t_ns);
  json_.string("frame_id", "map");
  // An entity replaces the one before it of the same id: the walls of the former map.
  json_.string("id", "walls");
  write_time(json_, "lifetime", 0);
  json_.boolean("frame_locked", true);
  for (const char* none :
       {"metadata", "arrows", "spheres", "cylinders", "lines", "triangles", "texts", "models"}) {
    json_.open_array(none);
    json_.close_array();
  }
  json_.open_array("cubes");
  for (const core::Wall& wall : plan.walls) write_wall(json_, wall);
  json_.close_array();
  json_.close_object();
  json_.close_array();
  json_.close_object();
  emit(ChannelId::kWalls, t_ns, json_.view());
}

}  // namespace cornerd::foxglove
