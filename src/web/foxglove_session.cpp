// SPDX-License-Identifier: MIT
#include "web/foxglove_session.hpp"

#include <array>
#include <cmath>
#include <utility>

#include <nlohmann/json.hpp>

namespace cornerd::web {

namespace {

using foxglove::ChannelId;
using nlohmann::json;

constexpr std::array<std::string_view, 2> kProtocols = {"foxglove.sdk.v1", "foxglove.websocket.v1"};
constexpr std::string_view kInitialPose = "/initialpose";
constexpr char kMessageData = 1;
constexpr std::size_t kMaxSubscriptions = 64;
/// A map of 10,000 walls: the page shows larger ones with less memory.
constexpr std::size_t kMaxShownMapBytes = 1024 * 1024;
constexpr int kErrorLevel = 2;

template <typename T>
void append_number(std::string& out, T value) {
  for (std::size_t i = 0; i < sizeof value; ++i) {
    out += static_cast<char>(static_cast<std::uint64_t>(value) >> (8 * i) & 0xff);
  }
}

std::uint32_t read_number(std::string_view bytes) {
  std::uint32_t value = 0;
  for (std::size_t i = 0; i < sizeof value; ++i) {
    value |= static_cast<std::uint32_t>(static_cast<unsigned char>(bytes[i])) << (8 * i);
  }
  return value;
}

bool is_id(const json& value) {
  return value.is_number_unsigned() && value.get<std::uint64_t>() <= UINT32_MAX;
}

/// An array of the object; an empty one if it has none.
const json& list(const json& object, const char* name) {
  static const json kNone = json::array();
  const auto found = object.find(name);
  return found != object.end() && found->is_array() ? *found : kNone;
}

bool is_text(const json& object, const char* name, std::string_view value) {
  const auto found = object.is_object() ? object.find(name) : object.end();
  return found != object.end() && found->is_string() &&
         found->get_ref<const std::string&>() == value;
}

std::string server_info(bool may_publish) {
  json info = {{"op", "serverInfo"},
               {"name", "cornerd"},
               {"capabilities", json::array()},
               {"supportedEncodings", {foxglove::kMessageEncoding}},
               {"metadata", json::object()}};
  if (may_publish) info["capabilities"].push_back("clientPublish");
  return info.dump();
}

std::string advertise() {
  json channels = json::array();
  for (const foxglove::Channel& channel : foxglove::channels()) {
    channels.push_back({{"id", static_cast<int>(channel.id)},
                        {"topic", channel.topic},
                        {"encoding", foxglove::kMessageEncoding},
                        {"schemaName", channel.schema_name},
                        {"schema", channel.schema},
                        {"schemaEncoding", foxglove::kSchemaEncoding}});
  }
  return json{{"op", "advertise"}, {"channels", std::move(channels)}}.dump();
}

}  // namespace

std::string_view foxglove_protocol(std::string_view offered) {
  while (!offered.empty()) {
    const std::size_t comma = offered.find(',');
    std::string_view name = offered.substr(0, comma);
    while (name.starts_with(' ')) name.remove_prefix(1);
    while (name.ends_with(' ')) name.remove_suffix(1);
    for (const std::string_view known : kProtocols) {
      if (name == known) return known;
    }
    if (comma == std::string_view::npos) break;
    offered.remove_prefix(comma + 1);
  }
  return {};
}

FoxgloveSession::FoxgloveSession(bool may_publish) : may_publish_(may_publish) {
  frames_.push_back({false, server_info(may_publish)});
  frames_.push_back({false, advertise()});
}

void FoxgloveSession::on_text(std::string_view text) {
  const json message = json::parse(text, nullptr, /*allow_exceptions=*/false);
  if (!message.is_object()) return tell("a text message must be a JSON object");
  if (is_text(message, "op", "subscribe")) {
    for (const json& one : list(message, "subscriptions")) {
      if (!one.is_object() || !is_id(one.value("id", json())) ||
          !is_id(one.value("channelId", json()))) {
        return tell("a subscription must have id and channelId");
      }
      const auto channel = one["channelId"].get<std::uint32_t>();
      if (channel < 1 || channel > foxglove::channels().size()) return tell("no such channel");
      if (subscriptions_.size() == kMaxSubscriptions) return tell("too many subscriptions");
      subscriptions_[one["id"].get<SubscriptionId>()] = static_cast<ChannelId>(channel);
      map_wanted_ = map_wanted_ || static_cast<ChannelId>(channel) == ChannelId::kWalls;
    }
  } else if (is_text(message, "op", "unsubscribe")) {
    for (const json& id : list(message, "subscriptionIds")) {
      if (is_id(id)) subscriptions_.erase(id.get<SubscriptionId>());
    }
  } else if (is_text(message, "op", "advertise")) {
    for (const json& channel : list(message, "channels")) {
      if (!is_text(channel, "topic", kInitialPose)) continue;
      if (!is_text(channel, "encoding", foxglove::kMessageEncoding) ||
          !is_id(channel.value("id", json()))) {
        return tell("/initialpose takes foxglove.PoseInFrame as json");
      }
      if (initial_pose_channels_.size() == kMaxSubscriptions) return tell("too many channels");
      initial_pose_channels_.insert(channel["id"].get<std::uint32_t>());
    }
  } else if (is_text(message, "op", "unadvertise")) {
    for (const json& id : list(message, "channelIds")) {
      if (is_id(id)) initial_pose_channels_.erase(id.get<std::uint32_t>());
    }
  }
}

std::string FoxgloveSession::on_binary(std::string_view bytes) {
  constexpr std::size_t kHeader = 1 + sizeof(std::uint32_t);
  if (bytes.size() < kHeader || bytes[0] != kMessageData) return {};
  if (!initial_pose_channels_.contains(read_number(bytes.substr(1)))) return {};
  if (!may_publish_) {
    tell("the pose cannot be set from here: cornerd-web needs its token, or this machine");
    return {};
  }
  return pose_request(bytes.substr(kHeader));
}

std::string FoxgloveSession::pose_request(std::string_view text) {
  const json message = json::parse(text, nullptr, /*allow_exceptions=*/false);
  std::array<double, 6> values{};
  constexpr std::array<const char*, 6> kPointers = {"/pose/position/x",    "/pose/position/y",
                                                    "/pose/orientation/x", "/pose/orientation/y",
                                                    "/pose/orientation/z", "/pose/orientation/w"};
  for (std::size_t i = 0; i < values.size(); ++i) {
    const json::json_pointer pointer(kPointers[i]);
    if (!message.is_object() || !message.contains(pointer) || !message[pointer].is_number()) {
      tell("/initialpose: foxglove.PoseInFrame has a number at " + std::string(kPointers[i]));
      return {};
    }
    values[i] = message[pointer].get<double>();
  }
  if (!is_text(message, "frame_id", "map")) {
    tell("/initialpose: frame_id must be map");
    return {};
  }
  const auto [x_m, y_m, qx, qy, qz, qw] = values;
  const double theta_rad = std::atan2(2 * (qw * qz + qx * qy), 1 - 2 * (qy * qy + qz * qz));
  return json{{"class", "SET_POSE"}, {"x", x_m}, {"y", y_m}, {"theta", theta_rad}}.dump();
}

void FoxgloveSession::on_line(std::string_view line, core::TimeNs now_ns) {
  const bool is_map = line.starts_with(R"({"class":"MAP")");
  if (is_map && (!is_subscribed(ChannelId::kWalls) || line.size() > kMaxShownMapBytes)) return;
  converter_.convert(line, now_ns,
                     [this](ChannelId channel, core::TimeNs t_ns, std::string_view json_text) {
                       for (const auto& [id, subscribed] : subscriptions_) {
                         if (subscribed != channel) continue;
                         std::string bytes(1, kMessageData);
                         append_number(bytes, id);
                         append_number(bytes, static_cast<std::uint64_t>(t_ns));
                         frames_.push_back({true, bytes.append(json_text)});
                       }
                     });
}

void FoxgloveSession::on_connection(bool is_connected) {
  const json frame = is_connected ? json{{"op", "removeStatus"}, {"statusIds", {"daemon"}}}
                                  : json{{"op", "status"},
                                         {"id", "daemon"},
                                         {"level", kErrorLevel},
                                         {"message", "The daemon is away."}};
  frames_.push_back({false, frame.dump()});
}

void FoxgloveSession::tell(std::string_view text) {
  const json frame = {{"op", "status"}, {"level", kErrorLevel}, {"message", text}};
  frames_.push_back({false, frame.dump(-1, ' ', false, json::error_handler_t::replace)});
}

bool FoxgloveSession::take_map_wanted() { return std::exchange(map_wanted_, false); }

FoxgloveSession::Frame FoxgloveSession::take_frame() {
  Frame frame = std::move(frames_.front());
  frames_.pop_front();
  return frame;
}

bool FoxgloveSession::is_subscribed(ChannelId channel) const {
  for (const auto& [id, subscribed] : subscriptions_) {
    if (subscribed == channel) return true;
  }
  return false;
}

}  // namespace cornerd::web
