// SPDX-License-Identifier: MIT
// POSE of LineWriter.
#include "core/map/wall_map.hpp"
#include "message/line.hpp"
#include "message/place_text.hpp"
#include "message/state_names.hpp"

namespace cornerd::message {
namespace {

void write_covariance(JsonText& json, const core::Covariance3& covariance) {
  if (!covariance.allFinite()) return;
  json.open_object("cov");
  json.significant("xx", covariance(0, 0));
  json.significant("xy", covariance(0, 1));
  json.significant("xt", covariance(0, 2));
  json.significant("yy", covariance(1, 1));
  json.significant("yt", covariance(1, 2));
  json.significant("tt", covariance(2, 2));
  json.close_object();
}

void write_alternatives(JsonText& json, std::span<const core::Alternative> alternatives) {
  if (alternatives.empty()) return;
  json.open_array("alternatives");
  for (const core::Alternative& alternative : alternatives) {
    json.open_object();
    write_place(json, alternative.T_map_base);
    json.number("score", alternative.score, 4);
    json.close_object();
  }
  json.close_array();
}

}  // namespace

std::string_view LineWriter::pose(const core::PoseEstimate& pose, const core::FloorPlan* plan) {
  const bool names_place =
      pose.state != core::PoseState::kAmbiguous && pose.state != core::PoseState::kLost;
  begin("POSE");
  json_.integer("seq", pose.seq);
  json_.seconds("t", pose.t_ns);
  json_.string("state", to_string(pose.state));
  if (names_place) {
    write_place(json_, pose.T_map_base);
    write_covariance(json_, pose.covariance);
    if (pose.room && plan != nullptr && *pose.room < plan->rooms.size()) {
      json_.string("room", plan->rooms[*pose.room].name);
    }
  }
  json_.integer("corners", pose.corners);
  json_.integer("inliers", pose.inliers);
  if (names_place && pose.inliers > 0) write_metres(json_, "rmse", pose.rmse_m);
  json_.number("age", pose.age_s, kTimeDecimals);
  write_alternatives(json_, pose.alternatives);
  return finish();
}

}  // namespace cornerd::message
