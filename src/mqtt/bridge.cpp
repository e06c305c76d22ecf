// SPDX-License-Identifier: MIT
#include "mqtt/bridge.hpp"

#include <algorithm>
#include <utility>
#include <variant>

#include "message/json_text.hpp"
#include "message/parsed_line.hpp"
#include "mqtt/home_assistant.hpp"
#include "mqtt/robot_report.hpp"

namespace cornerd::mqtt {

namespace {

/// VDA 5050, section 6.10 (2.x), 6.1 (3.0): at least every 30 s.
constexpr double kStatePeriod_s = 30;
/// The interval that the factsheet promises.
constexpr double kMinStateInterval_s = 0.1;
constexpr double kReportPeriod_s = 1;
/// A report of a robot that stands still.
constexpr double kIdleReportPeriod_s = 10;
/// Between two attempts to have a map used: loading one takes a second.
constexpr double kMapRetryPeriod_s = 5;
constexpr int kAtLeastOnce = 1;

/// "message" of an ERROR; the text itself where there is none.
std::string reason_of(const client::Answer& answer) {
  const message::ParsedLine line = message::parse_line(answer.text);
  const auto* error = std::get_if<message::ParsedError>(&line);
  return error != nullptr ? error->text : answer.text;
}

core::TimeNs unix_ns(std::chrono::system_clock::time_point time) {
  return std::chrono::duration_cast<std::chrono::nanoseconds>(time.time_since_epoch()).count();
}

}  // namespace

Bridge::Bridge(const BridgeConfig& config, BrokerLink& broker, Ask ask)
    : config_(config), broker_(broker), ask_(std::move(ask)), vda5050_(config) {
  broker_.subscribe(vda5050_.topic("instantActions"));
  if (!config_.map.empty()) map_.emplace(config_, broker_, robot_, ask_);
}

void Bridge::on_daemon(client::Event event, std::string_view text, const Now& now) {
  switch (event) {
    case client::Event::kMessage:
      return take_line(text, now);
    case client::Event::kConnected:
      robot_.is_daemon_connected = true;
      robot_.pose.reset();
      if (map_) map_->on_daemon_connected();
      return;
    case client::Event::kLost:
      robot_.is_daemon_connected = false;
      robot_.is_driving = false;
      robot_.daemon_problem = text;
      return;
    case client::Event::kTimeout:
      return;
  }
}

void Bridge::take_line(std::string_view line, const Now& now) {
  const message::ParsedLine parsed = message::parse_line(line);
  if (const auto* pose = std::get_if<message::ParsedPose>(&parsed)) {
    robot_.note(*pose, now.steady_s);
    publish_visualization(now);
  } else if (const auto* status = std::get_if<message::ParsedStatus>(&parsed)) {
    robot_.faults = status->faults;
    robot_.hint = status->hint;
  } else if (const auto* map = std::get_if<message::ParsedMap>(&parsed)) {
    robot_.note_map(map->plan.name, map->plan.hash);
    if (map_) map_->on_daemon_map();
  } else if (const auto* version = std::get_if<message::ParsedVersion>(&parsed)) {
    robot_.daemon_version = version->version;
  }
}

void Bridge::publish_visualization(const Now& now) {
  if (config_.visualization_hz <= 0) return;
  // Poses come at a rate of their own: the half keeps 7 a second from becoming 3.5 where 5 may go.
  if (now.steady_s - visualization_s_ < 0.5 / config_.visualization_hz) return;
  if (!broker_.has_sent_all()) return;
  visualization_s_ = std::max(visualization_s_ + 1 / config_.visualization_hz,
                              now.steady_s - 0.5 / config_.visualization_hz);
  broker_.publish(vda5050_.topic("visualization"),
                  vda5050_.visualization(robot_, now.unix_time, now.steady_s), false, 0);
}

void Bridge::on_broker(const Message& message) {
  // A retained action is one of long ago, which a broker repeats at each connection.
  if (message.topic == vda5050_.topic("instantActions") && !message.is_retained) {
    take_actions(message.payload);
  }
  if (map_) map_->on_broker(message);
}

void Bridge::take_actions(std::string_view payload) {
  const InstantActions parsed = parse_instant_actions(payload);
  if (!parsed.problem.empty()) {
    // It has no identifier that could be answered.
    robot_.add_action({"", "", ActionStatus::kFailed, parsed.problem});
    robot_.set_action("", ActionStatus::kFailed, parsed.problem);
  }
  for (const InstantAction& action : parsed.actions) {
    if (robot_.add_action({action.id, action.type})) start(action);
  }
}

void Bridge::start(const InstantAction& action) {
  const auto done = [&](ActionStatus status, std::string result = {}) {
    robot_.set_action(action.id, status, std::move(result));
  };
  if (!action.problem.empty()) return done(ActionStatus::kFailed, action.problem);
  if (is_init_position(action.type)) return init_position(action);
  if (action.type == "stateRequest") {
    state_is_requested_ = true;
  } else if (action.type == "factsheetRequest") {
    factsheet_is_requested_ = true;
  } else if (action.type == "clearInstantActions") {
    robot_.clear_actions();
  } else {
    return done(ActionStatus::kFailed, "this robot has no action " + action.type);
  }
  done(ActionStatus::kFinished);
}

void Bridge::init_position(const InstantAction& action) {
  if (action.map.empty() || action.map == robot_.map_id() || action.map == robot_.map_name) {
    return set_pose(action);
  }
  message::JsonText line(256);
  line.open_object();
  line.string("class", "SET_MAP");
  line.string("name", action.map);
  line.close_object();
  line.end_line();
  const bool is_asked =
      ask_(std::string(line.view()), [this, action](const client::Answer& answer) {
        if (answer.kind != client::Answer::Kind::kOk) return finish(action.id, answer);
        set_pose(action);
      });
  if (!is_asked) robot_.set_action(action.id, ActionStatus::kFailed, "busy: try again");
}

void Bridge::set_pose(const InstantAction& action) {
  message::JsonText line(256);
  line.open_object();
  line.string("class", "SET_POSE");
  line.number("x", action.T_map_base.x_m, 5);
  line.number("y", action.T_map_base.y_m, 5);
  line.number("theta", action.T_map_base.theta_rad, 6);
  line.close_object();
  line.end_line();
  const bool is_asked =
      ask_(std::string(line.view()), [this, action](const client::Answer& answer) {
        if (answer.kind == client::Answer::Kind::kOk && !action.last_node.empty()) {
          robot_.last_node = action.last_node;
        }
        finish(action.id, answer);
      });
  if (!is_asked) robot_.set_action(action.id, ActionStatus::kFailed, "busy: try again");
}

void Bridge::finish(const std::string& id, const client::Answer& answer) {
  if (answer.kind == client::Answer::Kind::kOk) {
    robot_.set_action(id, ActionStatus::kFinished, "");
  } else {
    robot_.set_action(id, ActionStatus::kFailed, reason_of(answer));
  }
}

std::string Bridge::signature(const Now& now) const {
  std::string text(robot_.state_name());
  text += robot_.is_localized(config_.max_deviation_m, config_.max_age_s, now.steady_s) ? '+' : '-';
  text += robot_.is_driving ? 'd' : 's';
  for (const std::string* part : {&robot_.map_hash, &robot_.hint, &robot_.last_node,
                                  &robot_.map_problem, &robot_.daemon_problem}) {
    text.append(*part).push_back('\n');
  }
  for (const KeptMap& map : robot_.maps) {
    text += map.id + std::to_string(map.version) + (map.is_in_use ? "u" : "k");
  }
  for (const ActionState& action : robot_.actions) {
    text.append(action.id)
        .append(action.result)
        .push_back(static_cast<char>('0' + static_cast<int>(action.status)));
  }
  if (robot_.pose) text += robot_.pose->room;
  return text;
}

void Bridge::greet(const Now& now) {
  broker_.publish(vda5050_.topic("connection"),
                  vda5050_.connection(Vda5050::Connection::kOnline, now.unix_time), true,
                  kAtLeastOnce);
  factsheet_is_requested_ = state_is_requested_ = true;
  if (config_.home_assistant.empty()) return;
  for (const Message& message : home_assistant_discovery(config_, vda5050_.topic("connection"))) {
    broker_.publish(message.topic, message.payload, true, kAtLeastOnce);
  }
}

void Bridge::tick(const Now& now) {
  if (map_ && now.steady_s - map_retry_s_ >= kMapRetryPeriod_s) {
    map_retry_s_ = now.steady_s;
    map_->retry();
  }
  const std::uint64_t connections = broker_.connections();
  if (connections == 0) return;
  if (connections != greeted_) greet(now);
  const bool is_new = std::exchange(greeted_, connections) != connections;
  if (std::exchange(factsheet_is_requested_, false)) {
    broker_.publish(vda5050_.topic("factsheet"), vda5050_.factsheet(now.unix_time), true,
                    kAtLeastOnce);
  }
  const double state_age_s = now.steady_s - state_s_;
  bool is_event = false;
  if (is_new || state_age_s >= kMinStateInterval_s) {
    std::string is_now = signature(now);
    is_event = is_now != told_;
    if (is_event || state_is_requested_ || state_age_s >= kStatePeriod_s) {
      broker_.publish(vda5050_.topic("state"), vda5050_.state(robot_, now.unix_time, now.steady_s),
                      false, 0);
      told_ = std::move(is_now);
      state_is_requested_ = false;
      state_s_ = now.steady_s;
    }
  }
  const double report_age_s = now.steady_s - report_s_;
  if (is_event || is_new || report_age_s >= kIdleReportPeriod_s ||
      (robot_.is_driving && report_age_s >= kReportPeriod_s)) {
    report_s_ = now.steady_s;
    broker_.publish(
        robot_topic(config_),
        robot_report_json(report_of(robot_, config_, unix_ns(now.unix_time), now.steady_s)), true,
        0);
  }
}

void Bridge::say_goodbye(const Now& now) {
  broker_.publish(vda5050_.topic("connection"),
                  vda5050_.connection(Vda5050::Connection::kOffline, now.unix_time), true,
                  kAtLeastOnce);
}

}  // namespace cornerd::mqtt
