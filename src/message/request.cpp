// SPDX-License-Identifier: MIT
#include "message/request.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "message/field_reader.hpp"
#include "message/input_fields.hpp"

namespace cornerd::message {
namespace {

using Body = decltype(Request::body);

constexpr std::size_t kMaxIdBytes = 256;
constexpr std::size_t kMaxWatchedClasses = 64;

/// An id is any JSON scalar. The answer repeats it unchanged.
std::string read_id(const Json& object, FieldReader& fields) {
  const auto id = object.find("id");
  if (id == object.end()) return {};
  if (id->is_structured()) {
    fields.fail("\"id\" must be a string, a number, true, false or null");
    return {};
  }
  std::string text = id->dump();
  if (text.size() > kMaxIdBytes) {
    fields.fail("\"id\" has more than " + std::to_string(kMaxIdBytes) + " bytes");
    return {};
  }
  return text;
}

ClassSet read_classes(FieldReader& fields) {
  ClassSet classes;
  for (const Json& name : fields.array("classes", kMaxWatchedClasses)) {
    if (!name.is_string()) {
      fields.fail("\"classes\" must hold names of classes");
      break;
    }
    const auto& text = name.get_ref<const std::string&>();
    const auto message_class = message_class_from(text);
    if (!message_class) {
      fields.fail("\"classes\" holds an unknown class: " + text.substr(0, 64));
      break;
    }
    classes.insert(*message_class);
  }
  return classes;
}

Body read_poll(FieldReader& fields) {
  PollRequest poll;
  if (!fields.has("classes")) {
    poll.classes.insert(MessageClass::kPose);
    poll.classes.insert(MessageClass::kStatus);
    return poll;
  }
  poll.classes = read_classes(fields);
  ClassSet others = poll.classes;
  for (const MessageClass polled : kPolled) others.erase(polled);
  if (!others.empty()) {
    fields.fail(
        "\"classes\" of POLL may hold VERSION, POSE, STATUS, EVENT, MAP and ODOM: use WATCH");
  }
  return poll;
}

Body read_set_map(FieldReader& fields) {
  SetMapRequest request{std::string(fields.optional_text("name")),
                        std::string(fields.optional_text("file"))};
  if (request.name.empty() == request.file.empty()) {
    fields.fail("SET_MAP needs \"name\" or \"file\", and one of them only");
  } else if (request.file.find('\0') != std::string::npos) {
    fields.fail("\"file\" must not hold a zero byte");
  }
  return request;
}

Body read_set_pose(FieldReader& fields) {
  SetPoseRequest request;
  request.T_map_base.x_m = fields.number("x", kCoordinateLimitsM);
  request.T_map_base.y_m = fields.number("y", kCoordinateLimitsM);
  request.T_map_base.theta_rad = core::normalize_angle(fields.number("theta", kAngleLimitsRad));
  return request;
}

Body read_body(const std::string& name, FieldReader& fields) {
  if (name == "WATCH") return WatchRequest{read_classes(fields)};
  if (name == "POLL") return read_poll(fields);
  if (name == "RELOCALIZE") return RelocalizeRequest{};
  if (name == "SET_POSE") return read_set_pose(fields);
  if (name == "SET_MAP") return read_set_map(fields);
  if (name == "ODOMETRY") return read_odometry(fields);
  return RequestError{"class", "no request of this class: " + name.substr(0, 64)};
}

/// In the order of MessageClass.
constexpr std::array<std::string_view, kMessageClasses> kNames = {
    "VERSION", "POSE",   "SCAN",  "BREAKPOINTS", "ODOMETRY",
    "STATUS",  "SERIAL", "EVENT", "MAP",         "ODOM"};
static_assert(!kNames.back().empty());

}  // namespace

std::string class_names() {
  std::string names;
  for (const std::string_view name : kNames) names.append(names.empty() ? "" : ",").append(name);
  return names;
}

Request parse_request(std::string_view line) {
  Request request;
  RequestError error;
  const auto object = parse_object(line, kMaxRequestBytes, error);
  if (!object) {
    request.body = std::move(error);
    return request;
  }
  FieldReader fields(*object);
  request.id_json = read_id(*object, fields);
  if (!fields.has("class")) {
    request.body = RequestError{"class", "\"class\" is missing"};
    return request;
  }
  request.name = fields.text("class");
  if (!fields.error()) request.body = read_body(request.name, fields);
  if (fields.error()) request.body = *fields.error();
  return request;
}

std::string_view to_string(MessageClass message_class) {
  return kNames[static_cast<std::size_t>(message_class)];
}

std::optional<MessageClass> message_class_from(std::string_view name) {
  const auto found = std::find(kNames.begin(), kNames.end(), name);
  if (found == kNames.end()) return std::nullopt;
  return static_cast<MessageClass>(found - kNames.begin());
}

}  // namespace cornerd::message
