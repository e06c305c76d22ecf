// SPDX-License-Identifier: MIT
#include "mqtt/robot_state.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/geometry/angle.hpp"
#include "message/line_writer.hpp"

namespace cornerd::mqtt {

namespace {

/// Chi-square, 2 degrees of freedom, 95 %.
constexpr double kChiSquare95 = 5.991;
/// An A1 at its slowest gives a pose twice a second.
constexpr double kMaxSilence_s = 2;
/// Above the differences of two poses at rest; an A1's poses at rest differ by a millimetre.
constexpr double kDriving_m_s = 0.05;
constexpr double kDriving_rad_s = 0.1;

bool moves_between(const message::ParsedPose& before, const message::ParsedPose& after) {
  if (!before.T_map_base || !after.T_map_base) return false;
  const double dt_s = core::to_seconds(after.t_ns - before.t_ns);
  if (dt_s < 0.02 || dt_s > 1) return false;
  const double way_m = (after.T_map_base->translation() - before.T_map_base->translation()).norm();
  const double turn_rad =
      std::abs(core::angle_between(before.T_map_base->theta_rad, after.T_map_base->theta_rad));
  return way_m > kDriving_m_s * dt_s || turn_rad > kDriving_rad_s * dt_s;
}

}  // namespace

std::optional<double> RobotState::deviation_m() const {
  if (!pose || !pose->covariance) return std::nullopt;
  const core::Covariance3& covariance = *pose->covariance;
  const double mean = (covariance(0, 0) + covariance(1, 1)) / 2;
  const double half_difference = (covariance(0, 0) - covariance(1, 1)) / 2;
  const double largest = mean + std::hypot(half_difference, covariance(0, 1));
  if (!(largest >= 0)) return std::nullopt;
  return std::sqrt(kChiSquare95 * largest);
}

bool RobotState::is_localized(double max_deviation_m, double max_age_s, double now_s) const {
  if (!is_daemon_connected || !pose || !pose->T_map_base) return false;
  if (now_s - pose_arrival_s > kMaxSilence_s) return false;
  const std::optional<double> deviation = deviation_m();
  return pose->age_s.value_or(0) <= max_age_s && deviation && *deviation <= max_deviation_m;
}

std::string_view RobotState::state_name() const {
  if (!is_daemon_connected || !pose) return "absent";
  return message::to_string(pose->state);
}

std::string RobotState::map_id() const {
  for (const KeptMap& map : maps) {
    if (map.is_in_use) return map.id;
  }
  return pose && !pose->map.empty() ? pose->map : map_name;
}

std::uint64_t RobotState::map_version() const {
  for (const KeptMap& map : maps) {
    if (map.is_in_use) return map.version;
  }
  return 0;
}

void RobotState::note(const message::ParsedPose& newest, double now_s) {
  is_driving = pose && moves_between(*pose, newest);
  pose = newest;
  pose_arrival_s = now_s;
  if (newest.T_map_base) T_map_base = newest.T_map_base;
}

void RobotState::note_map(const std::string& name, const std::string& hash) {
  map_name = name;
  if (std::exchange(map_hash, hash) == hash) return;
  T_map_base.reset();
  if (pose) pose->T_map_base.reset();
}

bool RobotState::add_action(ActionState action) {
  const bool is_known = std::any_of(actions.begin(), actions.end(),
                                    [&](const ActionState& one) { return one.id == action.id; });
  if (is_known) return false;
  actions.push_back(std::move(action));
  if (actions.size() > kMaxActionStates) actions.pop_front();
  return true;
}

void RobotState::clear_actions() {
  std::erase_if(actions,
                [](const ActionState& one) { return one.status != ActionStatus::kRunning; });
}

void RobotState::set_action(std::string_view id, ActionStatus status, std::string result) {
  for (ActionState& action : actions) {
    if (action.id != id) continue;
    action.status = status;
    action.result = std::move(result);
  }
}

}  // namespace cornerd::mqtt
