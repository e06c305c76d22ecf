// SPDX-License-Identifier: MIT
#include "web/router.hpp"

#include <algorithm>
#include <charconv>
#include <utility>

#include "web/control.hpp"
#include "web/metrics.hpp"
#include "web/page.hpp"

namespace cornerd::web {

namespace {

using message::MessageClass;

constexpr std::string_view kMapsFolder = "/api/maps/";
/// Of 20,000 walls, which take 40 MB while they are checked.
constexpr std::size_t kMaxMapBytes = 1024 * 1024;
constexpr long kMaxRecordingSeconds = 60;
/// Each of up to 5 MB, as long as its reader takes.
constexpr long kMaxRecordings = 2;

const PageFile* find_file(std::string_view path) {
  const auto files = page_files();
  const auto found = std::find_if(files.begin(), files.end(),
                                  [&](const PageFile& file) { return file.path == path; });
  return found == files.end() ? nullptr : &*found;
}

/// The methods of a path, first the one that changes something; empty if there is no such path.
struct Methods {
  std::string_view read;
  std::string_view change;
  std::size_t max_body_bytes = 0;
};

Methods methods_of(const Request& request) {
  const std::string_view path = request.path;
  if (path == "/api/request") return {"", "POST", message::kMaxRequestBytes};
  // A map may have that name.
  if (path == "/api/maps/check" && request.method != "PUT") return {"", "POST", kMaxMapBytes};
  if (path.starts_with(kMapsFolder)) return {"", "PUT", kMaxMapBytes};
  for (const std::string_view known :
       {"/api/map", "/api/status", "/api/events", "/api/recording", "/api/maps", "/api/fleet",
        "/api/fleet/map", "/metrics", "/foxglove"}) {
    if (path == known) return {"GET", ""};
  }
  if (find_file(path) != nullptr) return {"GET", ""};
  return {};
}

bool is_json(std::string_view content_type) {
  return content_type.substr(0, content_type.find(';')) == "application/json";
}

Response last_line(const Hub& hub, MessageClass message_class) {
  const Line line = hub.last(message_class);
  if (!line) {
    return error_response(503, "unavailable",
                          hub.is_connected() ? "the daemon has not sent it yet" : hub.problem());
  }
  return {.body = *line + "\n"};
}

}  // namespace

message::ClassSet classes_from(std::string_view comma_separated, std::string* unknown) {
  if (comma_separated.empty()) comma_separated = "POSE,STATUS,EVENT";
  message::ClassSet classes;
  while (!comma_separated.empty()) {
    const std::size_t comma = comma_separated.find(',');
    const std::string_view name = comma_separated.substr(0, comma);
    if (const auto one = message::message_class_from(name)) {
      classes.insert(*one);
    } else if (unknown != nullptr) {
      *unknown = name.substr(0, 64);
    }
    if (comma == std::string_view::npos) break;
    comma_separated.remove_prefix(comma + 1);
  }
  return classes;
}

Router::Router(AccessRules rules, const std::filesystem::path& control_socket,
               const std::filesystem::path& maps, const Hub& hub,
               std::unique_ptr<const FleetLink> fleet)
    : rules_(std::move(rules)),
      control_socket_(control_socket),
      maps_(maps),
      hub_(hub),
      fleet_(std::move(fleet)) {}

Router::Decision Router::decide(const Request& request) const {
  const auto refuse = [](unsigned status, std::string_view code, std::string_view why) {
    return Decision{.kind = Kind::kRefused, .response = error_response(status, code, why)};
  };
  if (!is_allowed_host(request.host, rules_.own_name)) {
    return refuse(403, "host", "use this machine's address or its .local name");
  }
  if (!is_allowed_origin(request.origin, request.host, rules_.allowed_origins)) {
    return refuse(403, "origin", "another site's page: start cornerd-web with --allow-origin");
  }
  const Methods methods = methods_of(request);
  if (methods.read.empty() && methods.change.empty()) {
    return refuse(404, "path", "there is no such path");
  }
  // What a browser asks before another site's page may send a token or JSON.
  if (request.method == "OPTIONS" && !request.origin.empty()) {
    return {.kind = Kind::kRefused, .response = {.status = 204, .body = {}}};
  }
  if (!methods.read.empty() && request.method == methods.read) {
    if (find_file(request.path) == nullptr && !may_read(request, rules_)) {
      return refuse(401, "token", "the token is missing or wrong: Authorization: Bearer T");
    }
    if (request.path == "/foxglove") return {.kind = Kind::kFoxglove};
    if (request.path != "/api/events") return {.kind = Kind::kPage};
    std::string unknown;
    const message::ClassSet classes = classes_from(query_value(request.query, "classes"), &unknown);
    if (!unknown.empty()) return refuse(400, "classes", "no class of messages: " + unknown);
    return {.kind = Kind::kEvents, .classes = classes};
  }
  if (methods.change.empty() || request.method != methods.change) {
    return refuse(405, "method", "this path takes another method");
  }
  if (!may_change(request)) {
    return rules_.token.empty()
               ? refuse(403, "read-only", "from another machine only with a token: --token-file")
               : refuse(401, "token", "the token is missing or wrong: Authorization: Bearer T");
  }
  if (!is_json(request.content_type)) {
    return refuse(415, "content-type", "Content-Type must be application/json");
  }
  return {.kind = Kind::kWork, .max_body_bytes = methods.max_body_bytes};
}

Response Router::answer_fleet(const Request& request) const {
  if (!fleet_) {
    return error_response(404, "fleet", "no broker: start cornerd-web with --broker");
  }
  if (request.path == "/api/fleet") return {.body = fleet_->robots_json()};
  std::string line = fleet_->map_line(query_value(request.query, "name"));
  if (line.empty()) return error_response(404, "map", "the site has no such map");
  return {.body = std::move(line)};
}

Response Router::answer(const Request& request, Hub::Clock::time_point now) const {
  if (const PageFile* file = find_file(request.path)) {
    return {.content_type = std::string(file->content_type), .body = std::string(file->content)};
  }
  if (request.path == "/api/map") return last_line(hub_, MessageClass::kMap);
  if (request.path == "/api/status") return last_line(hub_, MessageClass::kStatus);
  if (request.path == "/api/maps") return maps_.list();
  if (request.path.starts_with("/api/fleet")) return answer_fleet(request);
  if (request.path == "/metrics") {
    return {.content_type = "text/plain; version=0.0.4; charset=utf-8", .body = metrics_text(hub_)};
  }
  const std::string text = query_value(request.query, "seconds");
  long seconds = kMaxRecordingSeconds;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), seconds);
  if (!text.empty() && (error != std::errc() || end != text.data() + text.size() || seconds < 1 ||
                        seconds > kMaxRecordingSeconds)) {
    return error_response(400, "seconds", "seconds must be a whole number from 1 to 60");
  }
  if (recordings_.use_count() > kMaxRecordings) {
    return error_response(503, "busy", "others are downloading a recording: try again soon");
  }
  return {.content_type = "application/x-ndjson",
          .body = hub_.recording(std::chrono::seconds(seconds), now),
          .download_name = "cornerd.ndjson",
          .place = recordings_};
}

Response Router::ask(const std::string& line) const { return ask_daemon(control_socket_, line); }

Response Router::work(const Request& request) const {
  if (request.path == "/api/request") return ask(request.body);
  if (request.path == "/api/maps/check" && request.method == "POST")
    return MapStore::check(request.body);
  return maps_.put(std::string_view(request.path).substr(kMapsFolder.size()), request.body);
}

}  // namespace cornerd::web
