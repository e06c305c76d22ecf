// SPDX-License-Identifier: MIT
#include "message/parsed_line.hpp"

#include <gtest/gtest.h>

#include <string>

#include "core/map/wall_map.hpp"
#include "core/scan.hpp"
#include "message/line_writer.hpp"

namespace cornerd::message {
namespace {

template <typename Parsed>
Parsed parse(std::string_view line) {
  ParsedLine read = parse_line(line);
  if (const auto* error = std::get_if<RequestError>(&read)) {
    ADD_FAILURE() << error->text << " in " << line;
    return {};
  }
  return std::get<Parsed>(read);
}

std::string parse_error(std::string_view line) {
  const ParsedLine read = parse_line(line);
  const auto* error = std::get_if<RequestError>(&read);
  return error == nullptr ? "none" : error->text;
}

core::PoseEstimate fix() {
  core::PoseEstimate pose;
  pose.seq = 7;
  pose.t_ns = 1'500'000'000;
  pose.state = core::PoseState::kFix;
  pose.T_map_base = {1.25, -2.5, 0.75};
  pose.covariance.diagonal() << 1e-6, 4e-6, 9e-6;
  pose.covariance(0, 2) = pose.covariance(2, 0) = -1e-7;
  pose.room = 0;
  pose.corners = 5;
  pose.inliers = 200;
  pose.rmse_m = 0.003;
  pose.p_wrong = 0.125;
  return pose;
}

TEST(ParsedLine, Pose_WrittenByLineWriter_ReadBack) {
  LineWriter writer;
  core::FloorPlan plan;
  plan.rooms.push_back({"hall", {}});
  const auto pose = parse<ParsedPose>(writer.pose(fix(), &plan));
  EXPECT_EQ(pose.seq, 7U);
  EXPECT_EQ(pose.t_ns, 1'500'000'000);
  EXPECT_EQ(pose.state, core::PoseState::kFix);
  ASSERT_TRUE(pose.T_map_base);
  EXPECT_EQ(pose.T_map_base->x_m, 1.25);
  EXPECT_EQ(pose.T_map_base->theta_rad, 0.75);
  ASSERT_TRUE(pose.covariance);
  EXPECT_DOUBLE_EQ((*pose.covariance)(1, 1), 4e-6);
  EXPECT_DOUBLE_EQ((*pose.covariance)(2, 0), -1e-7);
  EXPECT_EQ(pose.room, "hall");
  EXPECT_EQ(pose.corners, 5U);
  EXPECT_EQ(pose.inliers, 200U);
  EXPECT_EQ(pose.rmse_m, 0.003);
  EXPECT_EQ(pose.age_s, 0);
  EXPECT_EQ(pose.p_wrong, 0.125);
}

TEST(ParsedLine, Odom_WrittenByLineWriter_ReadBack) {
  LineWriter writer;
  const auto odom =
      parse<ParsedOdom>(writer.odom({1'500'000'000, core::Pose2{1.25, -2, 0.5}, 0.25, -0.125}));
  EXPECT_EQ(odom.t_ns, 1'500'000'000);
  EXPECT_EQ(odom.T_odom_base.y_m, -2);
  EXPECT_EQ(odom.T_odom_base.theta_rad, 0.5);
  EXPECT_EQ(odom.vx_m_s, 0.25);
  EXPECT_EQ(odom.omega_rad_s, -0.125);
}

TEST(ParsedLine, AmbiguousPose_AlternativesAndNoPose) {
  LineWriter writer;
  core::PoseEstimate ambiguous = fix();
  ambiguous.state = core::PoseState::kAmbiguous;
  ambiguous.alternatives.push_back({{1, 2, 3}, 0.75});
  const auto pose = parse<ParsedPose>(writer.pose(ambiguous, nullptr));
  EXPECT_EQ(pose.state, core::PoseState::kAmbiguous);
  EXPECT_FALSE(pose.T_map_base);
  EXPECT_FALSE(pose.covariance);
  ASSERT_EQ(pose.alternatives.size(), 1U);
  EXPECT_EQ(pose.alternatives[0].T_map_base.y_m, 2);
  EXPECT_EQ(pose.alternatives[0].score, 0.75);
}

TEST(ParsedLine, Status_WrittenByLineWriter_ReadBack) {
  LineWriter writer;
  core::OdometrySummary odometry;
  odometry.enabled = true;
  odometry.counters.readings = 70;
  const StatusFields::Counter counters[] = {{"scans", 70}, {"bytes", 12000}};
  const StatusFields::Sensor sensors[] = {{"left", "absent", "no counter"},
                                          {"gyro", "running", ""}};
  StatusFields fields;
  fields.t_ns = 2'000'000'000;
  fields.lidar_state = "faulty";
  fields.lidar_fault = "dead-laser";
  fields.lidar_detail = "nothing returns";
  fields.lidar_model = "A1";
  fields.rate_hz = 7.125;
  fields.mount = {{0.04, 0, 1.5}, false};
  fields.counters = counters;
  fields.odometry = &odometry;
  fields.odometry_sensors = sensors;
  fields.odometry_hint = "lines lack left";
  fields.latency = {0.001, 0.002, 0.004, true};
  const auto status = parse<ParsedStatus>(writer.status(fields));
  EXPECT_EQ(status.t_ns, 2'000'000'000);
  EXPECT_EQ(status.lidar_state, "faulty");
  EXPECT_EQ(status.lidar_fault, "dead-laser");
  EXPECT_EQ(status.lidar_detail, "nothing returns");
  EXPECT_EQ(status.lidar_model, "A1");
  ASSERT_TRUE(status.T_base_lidar);
  EXPECT_EQ(status.T_base_lidar->x_m, 0.04);
  EXPECT_EQ(status.T_base_lidar->theta_rad, 1.5);
  EXPECT_EQ(status.lidar_firmware, "");
  EXPECT_EQ(status.rate_hz, 7.125);
  EXPECT_EQ(status.counter("scans"), 70U);
  EXPECT_EQ(status.counter("nothing"), 0U);
  EXPECT_EQ(status.odometry_state, "absent");
  EXPECT_EQ(status.odometry_hint, "lines lack left");
  EXPECT_EQ(status.odometry_readings, 70);
  ASSERT_EQ(status.odometry_sensors.size(), 2U);
  EXPECT_EQ(status.odometry_sensors[1].name, "left");
  EXPECT_EQ(status.odometry_sensors[1].detail, "no counter");
  EXPECT_EQ(status.latency_p99_s, 0.004);
}

TEST(ParsedLine, Breakpoints_WrittenByLineWriter_ReadBack) {
  LineWriter writer;
  core::Detection detection;
  detection.breakpoints.resize(2);
  detection.breakpoints[0].position = {1.5, -0.5};
  detection.breakpoints[0].kind = core::BreakpointKind::kCorner;
  detection.breakpoints[1].kind = core::BreakpointKind::kTerminal;
  const auto read = parse<ParsedBreakpoints>(writer.breakpoints(3'000'000'000, detection));
  EXPECT_EQ(read.t_ns, 3'000'000'000);
  ASSERT_EQ(read.points.size(), 2U);
  EXPECT_EQ(read.points[0].position, core::Vec2(1.5, -0.5));
  EXPECT_TRUE(read.points[0].is_corner);
  EXPECT_FALSE(read.points[1].is_corner);
}

core::FloorPlan plan_of_all_kinds() {
  core::FloorPlan plan;
  plan.name = "hall \"A\"";
  plan.hash = std::string(64, 'e');
  plan.thickness_m = 0.1;
  plan.sigma_m = 0.03;
  // Numbers without a short decimal fraction, too.
  plan.walls = {{{0, 0}, {1.0 / 3, -1e-7}, 0.1},
                {{-9999.125, 2}, {4, 3}, 0.25, 0.03, {false, true}}};
  plan.rooms = {{"one", {{0, 0}, {1, 0}, {0.7, 0.1}}}};
  return plan;
}

TEST(ParsedLine, Map_WrittenByLineWriter_ReadBackExactly) {
  LineWriter writer;
  const core::FloorPlan plan = plan_of_all_kinds();
  const core::FloorPlan read = parse<ParsedMap>(writer.map(plan)).plan;
  EXPECT_EQ(read.name, plan.name);
  EXPECT_EQ(read.hash, plan.hash);
  EXPECT_EQ(read.thickness_m, plan.thickness_m);
  EXPECT_EQ(read.sigma_m, plan.sigma_m);
  ASSERT_EQ(read.walls.size(), plan.walls.size());
  for (std::size_t i = 0; i < read.walls.size(); ++i) {
    EXPECT_EQ(read.walls[i].sigma_m, plan.walls[i].sigma_m);
    EXPECT_EQ(read.walls[i].is_open, plan.walls[i].is_open);
    EXPECT_EQ(read.walls[i].from, plan.walls[i].from);
    EXPECT_EQ(read.walls[i].to, plan.walls[i].to);
    EXPECT_EQ(read.walls[i].thickness_m, plan.walls[i].thickness_m);
  }
  ASSERT_EQ(read.rooms.size(), 1U);
  EXPECT_EQ(read.rooms[0].name, "one");
  EXPECT_EQ(read.rooms[0].polygon, plan.rooms[0].polygon);
}

TEST(ParsedLine, WrongMap_NamedInError) {
  const auto map_error = [](const std::string& rest) {
    return parse_error(R"({"class":"MAP","name":"a",)" + rest + "}");
  };
  EXPECT_EQ(map_error(R"("walls":7)"), "\"walls\" must be an array");
  EXPECT_EQ(map_error(R"("walls":[{"from":[0,0],"to":[1,0],"open":[true,1]}])"),
            "\"walls\": \"open\" must hold two of true and false");
  EXPECT_EQ(map_error(R"("walls":[7])"), "\"walls\": \"from\" is missing");
  EXPECT_EQ(map_error(R"("walls":[{"from":[0,0],"to":[1]}])"),
            "\"walls\": \"to\" must hold points [x, y]");
  EXPECT_EQ(map_error(R"("walls":[{"from":[0,0],"to":[1,"x"]}])"),
            "\"walls\": \"to\"[1] must be a number");
  EXPECT_EQ(map_error(R"("walls":[],"rooms":[{"name":"r","polygon":[7]}])"),
            "\"rooms\": \"polygon\" must hold points [x, y]");
}

TEST(ParsedLine, OtherClasses_WrittenByLineWriter_ReadBack) {
  LineWriter writer;
  core::Scan scan;
  core::Sample sample;
  sample.range_m = 2.5F;
  ASSERT_TRUE(scan.add(sample));
  EXPECT_EQ(parse<RecordedScan>(writer.scan(scan)).samples.at(0).range_m, 2.5F);
  const auto event = parse<ParsedEvent>(writer.event(1, "device lost", "absent"));
  EXPECT_EQ(event.what + "/" + event.detail, "device lost/absent");
  EXPECT_EQ(parse<ParsedVersion>(writer.version("cornerd", "1.2.3")).version, "1.2.3");
  EXPECT_EQ(parse<ParsedError>(writer.error("too-long", "cut it", "", "")).code, "too-long");
  EXPECT_EQ(parse<OtherLine>(writer.ok("WATCH", "")).name, "OK");
}

TEST(ParsedLine, WrongField_NamedInError) {
  EXPECT_NE(parse_error("hello"), "none");
  EXPECT_EQ(parse_error("{}"), "\"class\" is missing");
  EXPECT_EQ(parse_error(R"({"class":"POSE","t":1})"), "\"state\" is missing");
  EXPECT_EQ(parse_error(R"({"class":"POSE","t":1,"state":"happy"})"), "\"state\" is unknown");
  EXPECT_EQ(parse_error(R"({"class":"POSE","t":1,"state":"fix","x":1,"y":2})"),
            "\"theta\" is missing");
  EXPECT_EQ(parse_error(R"({"class":"POSE","t":1,"state":"lost","alternatives":[7]})"),
            "\"alternatives\": \"x\" is missing");
  EXPECT_EQ(parse_error(R"({"class":"STATUS","t":1})"), "\"lidar\": \"state\" is missing");
  EXPECT_EQ(parse_error(R"({"class":"STATUS","t":1,"lidar":{"state":"x"},"latency":[]})"),
            "\"latency\" must be an object");
  EXPECT_EQ(parse_error(R"({"class":"BREAKPOINTS","t":1,"points":[{"x":1,"y":1}]})"),
            "\"points\": \"kind\" is missing");
}

}  // namespace
}  // namespace cornerd::message
