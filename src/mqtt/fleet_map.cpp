// SPDX-License-Identifier: MIT
#include "mqtt/fleet_map.hpp"

#include <system_error>
#include <utility>
#include <variant>

#include "message/json_text.hpp"
#include "message/parsed_line.hpp"
#include "settings/map_file.hpp"
#include "settings/sha256.hpp"

namespace cornerd::mqtt {

FleetMap::FleetMap(const BridgeConfig& config, BrokerLink& broker, RobotState& robot, Ask ask)
    : config_(config),
      broker_(broker),
      robot_(robot),
      ask_(std::move(ask)),
      folder_(config.map_folder, config.map) {
  broker_.subscribe(map_topic(config_.site, config_.map));
  describe();
}

void FleetMap::on_broker(const Message& message) {
  if (message.topic == map_topic(config_.site, config_.map)) {
    take_announcement(message.payload);
  } else if (fetched_ && message.topic == map_file_topic(config_.site, *fetched_)) {
    take_file(message.payload);
  }
}

void FleetMap::refuse(std::uint64_t version, const std::string& reason) {
  robot_.map_problem = "map " + config_.map + " version " + std::to_string(version) + ": " +
                       settings::one_line(reason);
}

void FleetMap::stop_fetching() {
  if (fetched_) broker_.unsubscribe(map_file_topic(config_.site, *fetched_));
  fetched_.reset();
}

void FleetMap::take_announcement(std::string_view payload) {
  stop_fetching();
  robot_.map_problem.clear();
  if (payload.empty()) return;  // taken back: the robot keeps what it has
  const auto announcement = parse_map_announcement(payload);
  if (!announcement || announcement->map != config_.map) {
    robot_.map_problem = "the announcement of map " + config_.map + " is no announcement of it";
    return;
  }
  const std::uint64_t kept = folder_.files().empty() ? 0 : folder_.files().front().version;
  if (announcement->version < kept) return;
  if (announcement->version == kept) {
    if (announcement->sha256 != folder_.files().front().sha256) {
      refuse(kept, "is kept with another SHA-256: publish it as a new version");
    }
    return;
  }
  fetched_ = announcement;
  is_fetch_slow_ = false;
  broker_.subscribe(map_file_topic(config_.site, *fetched_));
}

void FleetMap::take_file(std::string_view text) {
  if (text.empty()) return;
  const MapAnnouncement announcement = *fetched_;
  stop_fetching();
  if (text.size() != announcement.bytes || settings::sha256(text) != announcement.sha256) {
    return refuse(announcement.version, "its bytes are not those of its SHA-256: not used");
  }
  try {
    settings::parse_map(text, config_.map);
    folder_.add(announcement.version, text);
  } catch (const settings::SettingsError& error) {
    return refuse(announcement.version, error.what());
  } catch (const std::system_error& error) {
    return refuse(announcement.version, std::string("cannot be kept: ") + error.what());
  }
  robot_.map_problem.clear();
  describe();
  if (robot_.is_daemon_connected) {
    switch_daemon();
  } else {
    is_switch_due_ = true;
  }
}

void FleetMap::on_daemon_connected() {
  is_switch_due_ = true;
  is_retry_due_ = false;
}

void FleetMap::on_daemon_map() {
  describe();
  if (!std::exchange(is_switch_due_, false) || folder_.files().empty()) return;
  if (folder_.files().front().sha256 != robot_.map_hash) switch_daemon();
}

void FleetMap::retry() {
  if (fetched_ && std::exchange(is_fetch_slow_, true)) {
    refuse(fetched_->version, "its bytes have not come yet: if they do not, publish it again");
  }
  if (!robot_.is_daemon_connected || !std::exchange(is_retry_due_, false)) return;
  if (folder_.files().empty() || folder_.files().front().sha256 == robot_.map_hash) return;
  switch_daemon();
}

void FleetMap::switch_daemon() {
  const MapFolder::File& newest = folder_.files().front();
  message::JsonText line(256);
  line.open_object();
  line.string("class", "SET_MAP");
  line.string("file", std::filesystem::absolute(newest.path).native());
  line.close_object();
  line.end_line();
  const bool is_asked =
      ask_(std::string(line.view()),
           [this, version = newest.version](const auto& answer) { on_answer(version, answer); });
  if (is_asked) return;
  is_retry_due_ = true;
  refuse(newest.version, "the daemon is busy: tried again");
}

void FleetMap::on_answer(std::uint64_t version, const client::Answer& answer) {
  using Kind = client::Answer::Kind;
  if (answer.kind == Kind::kOk) {
    robot_.map_problem.clear();
    return describe();
  }
  const message::ParsedLine line = message::parse_line(answer.text);
  const auto* error = std::get_if<message::ParsedError>(&line);
  // Neither says anything of the map.
  if (answer.kind == Kind::kNone || (error != nullptr && error->code == "busy")) {
    is_retry_due_ = true;
    return refuse(version, error != nullptr ? error->text : answer.text);
  }
  refuse(version, "the daemon refuses it: " + (error != nullptr ? error->text : answer.text));
  if (!folder_.files().empty() && folder_.files().front().version == version) {
    folder_.drop_newest();
  }
  describe();
}

void FleetMap::describe() {
  robot_.maps.clear();
  for (const MapFolder::File& file : folder_.files()) {
    robot_.maps.push_back({config_.map, file.version, file.sha256 == robot_.map_hash});
  }
}

}  // namespace cornerd::mqtt
