// SPDX-License-Identifier: MIT
#include "mqtt/map_announcement.hpp"

#include <algorithm>

#include "message/field_reader.hpp"
#include "message/json_text.hpp"
#include "mqtt/config.hpp"

namespace cornerd::mqtt {

namespace {

constexpr std::size_t kMaxAnnouncementBytes = 4096;
constexpr double kLargestExact = 9007199254740992.0;

bool is_sha256(std::string_view text) {
  return text.size() == 64 && std::all_of(text.begin(), text.end(), [](char c) {
           return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'f');
         });
}

}  // namespace

std::string map_topic(const std::string& site, const std::string& map) {
  return "cornerd/" + site + "/map/" + map;
}

std::string map_file_topic(const std::string& site, const MapAnnouncement& announcement) {
  return map_topic(site, announcement.map) + "/" + announcement.sha256;
}

std::string map_announcement_json(const MapAnnouncement& announcement) {
  message::JsonText json(256);
  json.open_object();
  json.string("map", announcement.map);
  json.integer("version", announcement.version);
  json.string("sha256", announcement.sha256);
  json.integer("bytes", announcement.bytes);
  json.close_object();
  return std::string(json.view());
}

std::optional<MapAnnouncement> parse_map_announcement(std::string_view payload) {
  message::RequestError error;
  const auto object = message::parse_object(payload, kMaxAnnouncementBytes, error);
  if (!object) return std::nullopt;
  message::FieldReader fields(*object);
  MapAnnouncement announcement;
  announcement.map = fields.text("map");
  const auto version = fields.optional_integer("version");
  if (!version || *version < 1 || static_cast<double>(*version) > kLargestExact) {
    fields.fail("version");
  }
  announcement.version = static_cast<std::uint64_t>(version.value_or(0));
  announcement.sha256 = fields.text("sha256");
  announcement.bytes =
      static_cast<std::size_t>(fields.number("bytes", {1, static_cast<double>(kMaxFleetMapBytes)}));
  if (!is_topic_level(announcement.map) || !is_sha256(announcement.sha256)) fields.fail("level");
  if (fields.error()) return std::nullopt;
  return announcement;
}

}  // namespace cornerd::mqtt
