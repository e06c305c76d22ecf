// SPDX-License-Identifier: MIT
// cornerctl map publish: a map for every robot of a site.
#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "mqtt/config.hpp"
#include "mqtt/map_announcement.hpp"
#include "settings/map_file.hpp"
#include "settings/sha256.hpp"
#include "tool/command_line/command.hpp"
#include "tool/command_line/failure.hpp"
#include "tool/command_line/output.hpp"
#include "tool/commands.hpp"
#include "tool/fleet/broker_options.hpp"

namespace cornerd::tool {

namespace {

/// A retained message comes with the acknowledgement of the subscription.
constexpr std::chrono::milliseconds kRetainedTime{1000};

struct PublishOptions {
  std::filesystem::path map;
  std::string name;
  BrokerOptions broker;
};

std::optional<mqtt::MapAnnouncement> announced(mqtt::Broker& broker, const std::string& topic) {
  std::optional<mqtt::MapAnnouncement> found;
  broker.subscribe(topic);
  take_until_silent(broker, kRetainedTime, [&](const mqtt::Message& message) {
    if (message.topic == topic) found = mqtt::parse_map_announcement(message.payload);
  });
  return found;
}

void publish(const PublishOptions& options) {
  const std::string text = settings::read_map_text(options.map);
  const auto map = settings::parse_map(text, options.map);
  if (text.size() > mqtt::kMaxFleetMapBytes) {
    throw Failure(options.map.string() + ": a fleet's map has at most 2 MiB");
  }
  mqtt::MapAnnouncement next;
  next.map = options.name.empty() ? map->plan().name : options.name;
  if (!mqtt::is_topic_level(next.map)) {
    throw UsageError("\"" + next.map + "\" is no level of a topic: choose another with --name");
  }
  next.sha256 = settings::sha256(text);
  next.bytes = text.size();

  const std::string site = options.broker.site();
  mqtt::Broker broker(options.broker.broker());
  wait_for_connection(broker);
  const std::string topic = mqtt::map_topic(site, next.map);
  const auto before = announced(broker, topic);
  Output output;
  if (before && before->sha256 == next.sha256) {
    output.write(next.map + " version " + std::to_string(before->version) + " is this map\n");
    return output.flush();
  }
  next.version = before ? before->version + 1 : 1;
  // The bytes first: the announcement makes robots ask for them.
  publish_retained(broker, mqtt::map_file_topic(site, next), text);
  publish_retained(broker, topic, mqtt::map_announcement_json(next));
  if (before) publish_retained(broker, mqtt::map_file_topic(site, *before), "");
  output.write(next.map + " version " + std::to_string(next.version) + ", " +
               std::to_string(next.bytes) + " bytes, SHA-256 " + next.sha256 + "\n");
  output.flush();
}

}  // namespace

void add_map_publish(Command& group) {
  Command command = group.add_subcommand("publish", "a map for every robot of a site, by MQTT");
  const auto options = std::make_shared<PublishOptions>();
  command.add_option("map", options->map, "the map").required().type_name("MAP");
  command
      .add_option("--name", options->name,
                  "/site/map of the robots' config; default: the map's name")
      .type_name("NAME");
  options->broker.add(command);
  command.callback([options] { publish(*options); });
}

}  // namespace cornerd::tool
