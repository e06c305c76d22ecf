// SPDX-License-Identifier: MIT
#include "web/fleet_link.hpp"

#include <chrono>

#include "message/json_text.hpp"
#include "message/line_writer.hpp"
#include "settings/map_file.hpp"
#include "settings/sha256.hpp"

namespace cornerd::web {

namespace {

constexpr std::chrono::milliseconds kPeriod{100};

double steady_s() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

}  // namespace

FleetLink::FleetLink(const mqtt::BrokerConfig& broker, const std::string& site)
    : site_(site), fleet_(site), broker_(broker) {
  broker_.subscribe(fleet_.filter());
  broker_.subscribe(mqtt::map_topic(site, "+"));
  follower_ = std::jthread([this](const std::stop_token& stop) { follow(stop); });
}

void FleetLink::follow(const std::stop_token& stop) {
  while (!stop.stop_requested()) {
    for (const mqtt::Message& message : broker_.take()) take(message);
    std::this_thread::sleep_for(kPeriod);
  }
}

void FleetLink::take(const mqtt::Message& message) {
  const std::lock_guard lock(mutex_);
  fleet_.take(message, steady_s(), std::chrono::system_clock::now());
  for (auto& [name, map] : maps_) {
    if (message.topic != mqtt::map_file_topic(site_, map.announcement)) continue;
    broker_.unsubscribe(message.topic);
    if (settings::sha256(message.payload) != map.announcement.sha256) return;
    try {
      map.line = message::LineWriter().map(settings::parse_map(message.payload, name)->plan());
    } catch (const settings::SettingsError&) {
      // No map: the robots refuse it too.
    }
    return;
  }
  take_announcement(message);
}

void FleetLink::take_announcement(const mqtt::Message& message) {
  const auto announcement = mqtt::parse_map_announcement(message.payload);
  if (!announcement || message.topic != mqtt::map_topic(site_, announcement->map)) return;
  if (maps_.size() >= kMaxMaps && !maps_.contains(announcement->map)) return;
  SiteMap& map = maps_[announcement->map];
  if (map.announcement.sha256 == announcement->sha256) return;
  if (!map.announcement.sha256.empty()) {
    broker_.unsubscribe(mqtt::map_file_topic(site_, map.announcement));
  }
  map = {*announcement, {}};
  broker_.subscribe(mqtt::map_file_topic(site_, *announcement));
}

std::string FleetLink::robots_json() const {
  const std::lock_guard lock(mutex_);
  message::JsonText json(4096);
  json.open_object();
  json.boolean("connected", broker_.is_connected());
  if (!broker_.is_connected()) json.text("problem", broker_.problem());
  json.open_array("maps");
  for (const auto& [name, map] : maps_) {
    json.open_object();
    json.string("name", name);
    json.integer("version", map.announcement.version);
    json.close_object();
  }
  json.close_array();
  json.open_array("robots");
  for (const mqtt::Fleet::Robot& robot : fleet_.robots(steady_s())) {
    std::string report = mqtt::robot_report_json(robot.report);
    report.pop_back();
    message::JsonText age(32);
    age.fixed(robot.age_s, 1);
    json.raw(report + ",\"age\":" + std::string(age.view()) + "}");
  }
  json.close_array();
  json.close_object();
  return std::string(json.view()) + "\n";
}

std::string FleetLink::map_line(const std::string& name) const {
  const std::lock_guard lock(mutex_);
  const auto found = maps_.find(name);
  return found == maps_.end() ? std::string() : found->second.line;
}

}  // namespace cornerd::web
