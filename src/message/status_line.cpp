// SPDX-License-Identifier: MIT
// STATUS of LineWriter.
#include "core/sensor_bias.hpp"
#include "message/line_writer.hpp"

namespace cornerd::message {
namespace {

void write_faults(JsonText& json, const StatusFields& status) {
  if (status.faults.empty()) return;
  json.open_array("faults");
  for (const std::string_view fault : status.faults) json.string(fault);
  json.close_array();
  json.text("hint", status.hint);
}

void write_bias(JsonText& json, const core::SensorBias& bias) {
  json.number("range_scale", bias.range_scale, kTimeDecimals);
  json.number("range_offset", bias.range_offset_m, kTimeDecimals);
  json.number("bearing_sine", bias.bearing_sine_rad, kTimeDecimals);
  json.number("bearing_cosine", bias.bearing_cosine_rad, kTimeDecimals);
}

void write_bias(JsonText& json, const core::EstimatedBias& estimated) {
  json.open_object("bias");
  write_bias(json, estimated.bias);
  json.open_object("sigma");
  write_bias(json, estimated.sigma);
  json.close_object();
  json.integer("scans", estimated.scans);
  json.close_object();
}

void write_mount(JsonText& json, const StatusFields::Mount& mount) {
  json.open_object("mount");
  json.number("x", mount.T_base_lidar.x_m, kTimeDecimals);
  json.number("y", mount.T_base_lidar.y_m, kTimeDecimals);
  json.key("theta");
  json.angle(mount.T_base_lidar.theta_rad);
  json.boolean("inverted", mount.inverted);
  if (mount.estimated) {
    const auto& [T_base_lidar, sigma] = *mount.estimated;
    json.open_object("estimated");
    json.number("x", T_base_lidar.x_m, kTimeDecimals);
    json.number("y", T_base_lidar.y_m, kTimeDecimals);
    json.key("theta");
    json.angle(T_base_lidar.theta_rad);
    json.open_object("sigma");
    json.number("x", sigma.x_m, kTimeDecimals);
    json.number("y", sigma.y_m, kTimeDecimals);
    json.number("theta", sigma.theta_rad, kTimeDecimals);
    json.close_object();
    json.close_object();
  }
  json.close_object();
}

void write_lidar(JsonText& json, const StatusFields& status) {
  json.open_object("lidar");
  json.text("state", status.lidar_state);
  json.text("fault", status.lidar_fault);
  json.text("detail", status.lidar_detail);
  json.text("model", status.lidar_model);
  json.text("firmware", status.lidar_firmware);
  json.text("serial", status.lidar_serial);
  json.text("health", status.lidar_health);
  json.text("mode", status.lidar_mode);
  json.number("rate_hz", status.rate_hz, 3);
  json.number("samples_hz", status.samples_hz, 1);
  if (status.mount) write_mount(json, *status.mount);
  if (status.bias != nullptr && status.bias->scans > 0) write_bias(json, *status.bias);
  json.close_object();
}

void write_each(JsonText& json, std::span<const StatusFields::Counter> counters) {
  for (const StatusFields::Counter& counter : counters) json.integer(counter.name, counter.value);
}

void write_counters(JsonText& json, std::span<const StatusFields::Counter> counters) {
  json.open_object("counters");
  write_each(json, counters);
  json.close_object();
}

void write_parameters(JsonText& json, const core::OdometryParameters& values) {
  json.number("delay", values.delay_s, kTimeDecimals);
  json.number("gyro_bias", values.gyro_bias_rad_s, kTimeDecimals);
  json.number("gyro_scale", values.gyro_scale, kTimeDecimals);
  json.number("left_scale", values.left_scale, kTimeDecimals);
  json.number("right_scale", values.right_scale, kTimeDecimals);
  json.number("track_scale", values.track_scale, kTimeDecimals);
}

void write_summary(JsonText& json, const StatusFields& status) {
  const core::OdometrySummary& odometry = *status.odometry;
  json.string("state", !odometry.present ? "absent" : odometry.healthy ? "running" : "unhealthy");
  json.text("hint", status.odometry_hint);
  write_parameters(json, odometry.parameters);
  json.open_object("sigma");
  write_parameters(json, odometry.sigma);
  json.close_object();
  const core::OdometryCounters& count = odometry.counters;
  const StatusFields::Counter counters[] = {{"readings", count.readings},
                                            {"past", count.past},
                                            {"future", count.future},
                                            {"jumps", count.jumps},
                                            {"invalid_rates", count.invalid_rates},
                                            {"stuck", count.stuck},
                                            {"gaps", count.gaps},
                                            {"restarts", count.restarts},
                                            {"slips", odometry.slips},
                                            {"fixes", odometry.fixes},
                                            {"rejected_fixes", odometry.rejected_fixes}};
  json.open_object("counters");
  write_each(json, counters);
  if (status.second_client) json.integer("second_client", *status.second_client);
  json.close_object();
  if (status.odometry_refusals.empty()) return;
  json.open_object("refused");
  write_each(json, status.odometry_refusals);
  json.close_object();
}

void write_sensors(JsonText& json, const StatusFields& status) {
  if (status.odometry_sensors.empty()) return;
  json.open_object("sensors");
  for (const StatusFields::Sensor& sensor : status.odometry_sensors) {
    json.open_object(sensor.name);
    json.string("state", sensor.state);
    json.text("detail", sensor.detail);
    json.close_object();
  }
  write_counters(json, status.odometry_counters);
  json.close_object();
}

void write_map(JsonText& json, const StatusFields& status) {
  if (!status.map) return;
  json.open_object("map");
  json.string("state", status.map->state);
  json.text("name", status.map->name);
  if (!status.map->candidates.empty()) {
    json.open_array("candidates");
    for (const std::string& name : status.map->candidates) json.string(name);
    json.close_array();
  }
  json.close_object();
}

void write_walls(JsonText& json, const StatusFields& status) {
  const StatusFields::Walls& walls = status.walls;
  if (walls.learned == 0) return;
  json.open_object("walls");
  json.integer("learned", walls.learned);
  json.number("sigma", walls.sigma_m, 4);
  json.number("offset", walls.offset_m, 4);
  json.integer("gone", status.walls_gone);
  json.integer("new", status.new_things);
  json.close_object();
}

void write_latency(JsonText& json, const StatusFields& status) {
  if (!status.latency.valid) return;
  json.open_object("latency");
  json.number("p50", status.latency.p50_s, kTimeDecimals);
  json.number("p95", status.latency.p95_s, kTimeDecimals);
  json.number("p99", status.latency.p99_s, kTimeDecimals);
  json.close_object();
}

void write_loop(JsonText& json, const StatusFields::Loop& loop) {
  json.open_object(loop.name);
  json.open_array("counts");
  for (const std::uint32_t count : loop.latency->counts) json.integer(count);
  json.close_array();
  json.number("max", core::to_seconds(loop.latency->max_ns), kTimeDecimals);
  if (loop.page_faults) json.integer("page_faults", *loop.page_faults);
  json.close_object();
}

void write_loops(JsonText& json, const StatusFields& status) {
  if (status.loops.empty()) return;
  json.open_object("realtime");
  json.integer("priority", status.realtime_priority);
  json.boolean("memory_locked", status.memory_is_locked);
  json.open_array("edges");
  for (const core::TimeNs edge_ns : core::LatencyHistogram::kEdgesNs) {
    json.fixed(core::to_seconds(edge_ns), kTimeDecimals);
  }
  json.close_array();
  for (const StatusFields::Loop& loop : status.loops) write_loop(json, loop);
  json.close_object();
}

}  // namespace

std::string_view LineWriter::status(const StatusFields& status) {
  begin("STATUS");
  json_.seconds("t", status.t_ns);
  write_faults(json_, status);
  write_lidar(json_, status);
  write_counters(json_, status.counters);
  if (status.odometry != nullptr &&
      (status.odometry->enabled || !status.odometry_sensors.empty())) {
    json_.open_object("odometry");
    write_summary(json_, status);
    write_sensors(json_, status);
    json_.close_object();
  }
  write_map(json_, status);
  write_walls(json_, status);
  write_latency(json_, status);
  write_loops(json_, status);
  return finish();
}

}  // namespace cornerd::message
