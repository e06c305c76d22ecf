// SPDX-License-Identifier: MIT
#include "message/line_writer.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <limits>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "core/map/wall_map.hpp"
#include "core/scan.hpp"
#include "line_text.hpp"
#include "message/request.hpp"

namespace cornerd::message {
namespace {

using nlohmann::json;
using ::testing::EndsWith;
using ::testing::HasSubstr;

std::vector<std::string> keys_of(const json& object) {
  std::vector<std::string> keys;
  for (const auto& [key, value] : object.items()) keys.push_back(key);
  return keys;
}

core::PoseEstimate some_pose(core::PoseState state) {
  core::PoseEstimate pose;
  pose.seq = 42;
  pose.t_ns = 1'700'000'000'123'456'000;
  pose.state = state;
  pose.T_map_base = {1.25, -0.5, 3.0};
  pose.covariance << 1e-6, 2e-7, 3e-7, 2e-7, 4e-6, 5e-7, 3e-7, 5e-7, 6e-6;
  pose.room = 1;
  pose.corners = 7;
  pose.inliers = 312;
  pose.rmse_m = 0.00456;
  pose.age_s = 0.25;
  pose.p_wrong = 1e-5;
  return pose;
}

core::FloorPlan two_rooms() {
  core::FloorPlan plan;
  plan.rooms = {{"hall", {}}, {"room \"1\"", {}}};
  return plan;
}

TEST(VersionLine, Always_HasProgramVersionAndSchema) {
  LineWriter writer;
  EXPECT_EQ(
      read(writer.version("cornerd", "1.2.3")),
      json({{"class", "VERSION"}, {"program", "cornerd"}, {"version", "1.2.3"}, {"schema", 2}}));
}

TEST(PoseLine, FixWithRoom_HasEveryField) {
  LineWriter writer;
  const core::FloorPlan plan = two_rooms();
  EXPECT_EQ(
      writer.pose(some_pose(core::PoseState::kFix), &plan),
      R"({"class":"POSE","seq":42,"t":1700000000.123456,"state":"fix","x":1.25,"y":-0.5,)"
      R"("theta":3,"cov":{"xx":1e-06,"xy":2e-07,"xt":3e-07,"yy":4e-06,"yt":5e-07,"tt":6e-06},)"
      R"("room":"room \"1\"","corners":7,"inliers":312,"rmse":0.00456,"age":0.25,"p_wrong":1e-05})"
      "\n");
}

TEST(PoseLine, OneMapOfSeveral_Named) {
  LineWriter writer;
  core::FloorPlan plan = two_rooms();
  plan.name = "floor 2";
  const std::vector<std::string> names = {"floor 1", "floor 2"};
  EXPECT_EQ(read(writer.pose(some_pose(core::PoseState::kFix), &plan, names))["map"], "floor 2");
  EXPECT_FALSE(read(writer.pose(some_pose(core::PoseState::kLost), &plan, names)).contains("map"));
}

TEST(PoseLine, MapNotKnown_AlternativesNameTheirs) {
  LineWriter writer;
  core::PoseEstimate pose = some_pose(core::PoseState::kAmbiguous);
  pose.alternatives = {{{1, 2, 0.5}, 0.6, 1}, {{-1, 0, -0.5}, 0.4, 0}};
  const json alternatives = read(
      writer.pose(pose, nullptr, std::vector<std::string>{"floor 1", "floor 2"}))["alternatives"];
  EXPECT_EQ(alternatives[0]["map"], "floor 2");
  EXPECT_EQ(alternatives[1]["map"], "floor 1");
}

TEST(PoseLine, EachState_Named) {
  LineWriter writer;
  const std::array<std::pair<core::PoseState, const char*>, 5> names = {
      {{core::PoseState::kFix, "fix"},
       {core::PoseState::kTracking, "tracking"},
       {core::PoseState::kPredicted, "predicted"},
       {core::PoseState::kAmbiguous, "ambiguous"},
       {core::PoseState::kLost, "lost"}}};
  for (const auto& [state, name] : names) {
    EXPECT_EQ(read(writer.pose(some_pose(state), nullptr))["state"], name);
  }
}

TEST(PoseLine, AmbiguousOrLost_HasNoPose) {
  LineWriter writer;
  const core::FloorPlan plan = two_rooms();
  for (const auto state : {core::PoseState::kAmbiguous, core::PoseState::kLost}) {
    const json line = read(writer.pose(some_pose(state), &plan));
    for (const char* key : {"x", "y", "theta", "cov", "room", "rmse"}) {
      EXPECT_FALSE(line.contains(key)) << key;
    }
    EXPECT_EQ(line["corners"], 7);
  }
}

TEST(PoseLine, WhatThisScanDoesNotName_HasNoProbability) {
  LineWriter writer;
  for (const auto state : {core::PoseState::kPredicted, core::PoseState::kLost}) {
    EXPECT_FALSE(read(writer.pose(some_pose(state), nullptr)).contains("p_wrong"));
  }
  core::PoseEstimate ambiguous = some_pose(core::PoseState::kAmbiguous);
  ambiguous.alternatives = {{{1, 2, 0.5}, 1.0}};
  EXPECT_EQ(read(writer.pose(ambiguous, nullptr))["p_wrong"], 1e-5);
}

TEST(PoseLine, Alternatives_Written_KeepOrder) {
  LineWriter writer;
  core::PoseEstimate pose = some_pose(core::PoseState::kAmbiguous);
  pose.alternatives = {{{1, 2, 0.5}, 1.0}, {{-1, 0, -0.5}, 0.87654321}};
  EXPECT_EQ(read(writer.pose(pose, nullptr))["alternatives"],
            json::parse(R"([{"x":1,"y":2,"theta":0.5,"score":1},
                            {"x":-1,"y":0,"theta":-0.5,"score":0.8765}])"));
}

TEST(PoseLine, RoomOutsidePlan_LeftOut) {
  LineWriter writer;
  core::PoseEstimate pose = some_pose(core::PoseState::kFix);
  const core::FloorPlan no_rooms;
  EXPECT_FALSE(read(writer.pose(pose, &no_rooms)).contains("room"));
  EXPECT_FALSE(read(writer.pose(pose, nullptr)).contains("room"));
}

TEST(PoseLine, NonFiniteNumbers_LeftOut) {
  LineWriter writer;
  core::PoseEstimate pose = some_pose(core::PoseState::kFix);
  pose.T_map_base.x_m = std::numeric_limits<double>::quiet_NaN();
  pose.T_map_base.theta_rad = std::numeric_limits<double>::infinity();
  pose.covariance(0, 1) = std::numeric_limits<double>::quiet_NaN();
  pose.rmse_m = std::numeric_limits<double>::infinity();
  pose.age_s = std::numeric_limits<double>::infinity();
  pose.p_wrong = std::numeric_limits<double>::quiet_NaN();
  const json line = read(writer.pose(pose, nullptr));
  EXPECT_THAT(keys_of(line), ::testing::UnorderedElementsAre("class", "seq", "t", "state", "y",
                                                             "corners", "inliers"));
}

TEST(BreakpointsLine, CornerAndTerminal_HaveTheirFields) {
  LineWriter writer;
  core::Detection detection;
  core::Breakpoint corner;
  corner.position = {1, 2};
  corner.opening_rad = 4.712389;
  corner.convex = true;
  corner.right_wall_rad = 0.5;
  corner.left_wall_rad = -1;
  corner.right_support = 9;
  corner.left_support = 8;
  core::Breakpoint terminal;
  terminal.kind = core::BreakpointKind::kTerminal;
  terminal.wall_on_left = false;
  detection.breakpoints = {corner, terminal};
  const json points = read(writer.breakpoints(0, detection))["points"];
  EXPECT_EQ(points[0], json::parse(R"({"x":1,"y":2,"kind":"corner","angle":4.712389,"convex":true,
    "right_wall":0.5,"right_support":9,"left_wall":-1,"left_support":8,
    "cov":{"xx":0,"xy":0,"yy":0}})"));
  EXPECT_EQ(points[1]["kind"], "terminal");
  EXPECT_FALSE(points[1].contains("angle"));
  EXPECT_FALSE(points[1].contains("left_wall"));
}

TEST(StatusLine, EmptyTextsAndNoLatency_LeftOut) {
  LineWriter writer;
  StatusFields status;
  status.lidar_state = "absent";
  const json line = read(writer.status(status));
  EXPECT_EQ(line["lidar"], json::parse(R"({"state":"absent","rate_hz":0,"samples_hz":0})"));
  EXPECT_FALSE(line.contains("latency"));
}

TEST(StatusLine, AllFields_Written) {
  LineWriter writer;
  const std::array<StatusFields::Counter, 2> counters = {{{"bytes", 7}, {"scans", 2}}};
  StatusFields status;
  status.t_ns = 1'000'000;
  status.lidar_state = "running";
  status.lidar_detail = "a\"b";
  status.lidar_model = "A1M8";
  status.lidar_firmware = "1.29";
  status.lidar_health = "good";
  status.lidar_mode = "Express";
  status.rate_hz = 5.51234;
  status.samples_hz = 3953.04;
  status.mount = {{0.04, -0.5, core::kPi}, true};
  status.counters = counters;
  status.latency = {0.001, 0.002, 0.003, true};
  EXPECT_EQ(read(writer.status(status)), json::parse(R"({"class":"STATUS","t":0.001,
    "lidar":{"state":"running","detail":"a\"b","model":"A1M8","firmware":"1.29","health":"good",
             "mode":"Express","rate_hz":5.512,"samples_hz":3953,
             "mount":{"x":0.04,"y":-0.5,"theta":3.141592,"inverted":true}},
    "counters":{"bytes":7,"scans":2},
    "latency":{"p50":0.001,"p95":0.002,"p99":0.003}})"));
}

TEST(StatusLine, Odometry_WritesParametersAndCounters) {
  LineWriter writer;
  core::OdometrySummary odometry;
  StatusFields status;
  status.lidar_state = "running";
  status.odometry = &odometry;
  EXPECT_FALSE(read(writer.status(status)).contains("odometry"));

  odometry.enabled = true;
  EXPECT_EQ(read(writer.status(status))["odometry"]["state"], "absent");
  odometry.present = true;
  EXPECT_EQ(read(writer.status(status))["odometry"]["state"], "unhealthy");
  odometry.healthy = true;
  odometry.parameters = {0.01, 0.015, 0.025, -0.002, 0.02, 0.004};
  odometry.sigma = {0.0002, 0.001, 0.001, 0.003, std::nan(""), 0.0001};
  odometry.counters = {100, 1, 2, 3, 4, 5, 6, 7};
  odometry.slips = 8;
  odometry.fixes = 9;
  odometry.rejected_fixes = 10;
  EXPECT_EQ(read(writer.status(status))["odometry"], json::parse(R"({"state":"running",
    "delay":0.004,"gyro_bias":0.01,"gyro_scale":0.02,"left_scale":0.015,"right_scale":0.025,"track_scale":-0.002,
    "sigma":{"delay":0.0001,"gyro_bias":0.0002,"left_scale":0.001,"right_scale":0.001,"track_scale":0.003},
    "counters":{"readings":100,"past":1,"future":2,"jumps":3,"invalid_rates":4,"stuck":5,"gaps":6,
                "restarts":7,"slips":8,"fixes":9,"rejected_fixes":10}})"));

  status.odometry_hint = "lines lack right";
  status.second_client = 11;
  const json line = read(writer.status(status))["odometry"];
  EXPECT_EQ(line["hint"], "lines lack right");
  EXPECT_EQ(line["counters"]["second_client"], 11);
}

TEST(AnswerLine, Id_Given_RepeatedUnchanged) {
  LineWriter writer;
  EXPECT_EQ(read(writer.ok("WATCH", "\"a\"")),
            json({{"class", "OK"}, {"request", "WATCH"}, {"id", "a"}}));
  EXPECT_FALSE(read(writer.ok("WATCH", "")).contains("id"));
  EXPECT_EQ(read(writer.error("json", "no \xff object", "", "12")),
            json({{"class", "ERROR"},
                  {"code", "json"},
                  {"message", "no \xef\xbf\xbd object"},
                  {"id", 12}}));
}

TEST(EventLine, EmptyDetail_LeftOut) {
  LineWriter writer;
  EXPECT_EQ(writer.event(0, "map loaded", ""),
            "{\"class\":\"EVENT\",\"t\":0.000000,\"what\":\"map loaded\"}\n");
  EXPECT_THAT(std::string(writer.event(0, "x", "y\nz")), HasSubstr(R"("detail":"y\nz")"));
}

TEST(SerialLine, AnyBytes_ReadBack) {
  LineWriter writer;
  const std::array<std::uint8_t, 3> bytes = {0xa5, 0x00, 0xff};
  const std::string line(writer.serial(2'000'000, LineWriter::Direction::kTx, bytes));
  EXPECT_THAT(line, EndsWith("\"tx\":\"a500ff\"}\n"));
  const auto parsed = std::get<RecordedBytes>(parse_recorded_line(line));
  EXPECT_FALSE(parsed.received);
  EXPECT_EQ(parsed.t_ns, 2'000'000);
  EXPECT_THAT(parsed.bytes, ::testing::ElementsAreArray(bytes));
}

TEST(OdometryLine, AbsentFields_LeftOut) {
  LineWriter writer;
  EXPECT_EQ(writer.odometry({.t_ns = 1'000'000'000, .left = {}, .right = {}, .gyro_rad_s = -0.25}),
            "{\"class\":\"ODOMETRY\",\"t\":1.000000,\"gyro\":-0.25}\n");
  const auto parsed = std::get<OdometryReading>(
      parse_recorded_line(writer.odometry({.t_ns = 0, .left = -5, .right = 6, .gyro_rad_s = {}})));
  EXPECT_EQ(parsed.left, -5);
  EXPECT_EQ(parsed.right, 6);
  EXPECT_EQ(parsed.gyro_rad_s, std::nullopt);
}

TEST(TruthLine, AnyPose_ReadBack) {
  LineWriter writer;
  const auto truth = std::get<RecordedTruth>(parse_truth_line(writer.truth(5'000, {1, -2, 0.5})));
  EXPECT_EQ(truth.t_ns, 5'000);
  EXPECT_EQ(truth.T_map_base.y_m, -2);
  EXPECT_EQ(truth.T_map_base.theta_rad, 0.5);
}

}  // namespace
}  // namespace cornerd::message
