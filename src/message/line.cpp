// SPDX-License-Identifier: MIT
#include "message/line.hpp"

#include "message/place_text.hpp"

namespace cornerd::message {
namespace {

/// 10240 samples of at most 10 + 9 + 4 + 9 characters each, with room for the rest.
constexpr std::size_t kLongestLine = 400 * 1024;

}  // namespace

LineWriter::LineWriter() : json_(kLongestLine) {}

void LineWriter::begin(std::string_view message_class) {
  json_.clear();
  json_.open_object();
  json_.string("class", message_class);
}

std::string_view LineWriter::finish() {
  json_.close_object();
  json_.end_line();
  return json_.view();
}

void LineWriter::id(std::string_view id_json) {
  if (!id_json.empty()) json_.raw("id", id_json);
}

std::string_view LineWriter::version(std::string_view program, std::string_view version) {
  begin("VERSION");
  json_.string("program", program);
  json_.string("version", version);
  json_.integer("schema", kSchema);
  return finish();
}

std::string_view LineWriter::event(core::TimeNs t_ns, std::string_view what,
                                   std::string_view detail) {
  begin("EVENT");
  json_.seconds("t", t_ns);
  json_.string("what", what);
  json_.text("detail", detail);
  return finish();
}

std::string_view LineWriter::ok(std::string_view request, std::string_view id_json) {
  begin("OK");
  json_.string("request", request);
  id(id_json);
  return finish();
}

std::string_view LineWriter::error(std::string_view code, std::string_view text,
                                   std::string_view request, std::string_view id_json) {
  begin("ERROR");
  json_.string("code", code);
  json_.string("message", text);
  json_.text("request", request);
  id(id_json);
  return finish();
}

std::string_view LineWriter::serial(core::TimeNs t_ns, Direction direction,
                                    std::span<const std::uint8_t> bytes) {
  begin("SERIAL");
  json_.seconds("t", t_ns);
  json_.key(direction == Direction::kRx ? "rx" : "tx");
  json_.hex(bytes);
  return finish();
}

std::string_view LineWriter::odometry(const OdometryFields& odometry) {
  begin("ODOMETRY");
  json_.seconds("t", odometry.t_ns);
  if (odometry.has_counts) {
    json_.integer("left", odometry.left);
    json_.integer("right", odometry.right);
  }
  if (odometry.has_gyro) json_.number("gyro", odometry.gyro_rad_s, 6);
  return finish();
}

std::string_view LineWriter::truth(core::TimeNs t_ns, const core::Pose2& T_map_base) {
  json_.clear();
  json_.open_object();
  json_.seconds("t", t_ns);
  write_place(json_, T_map_base);
  return finish();
}

}  // namespace cornerd::message
