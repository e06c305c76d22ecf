// SPDX-License-Identifier: MIT
#include "daemon/request_handler.hpp"

#include <variant>

namespace cornerd::daemon {
namespace {

using message::MessageClass;

/// Fewer than those that stop the handling of requests.
constexpr std::size_t kMaxUnreadErrors = 8;

template <typename... Handlers>
struct Overloaded : Handlers... {
  using Handlers::operator()...;
};
template <typename... Handlers>
Overloaded(Handlers...) -> Overloaded<Handlers...>;

}  // namespace

void RequestHandler::handle(Client& client, SocketRole role, std::string_view text) {
  const message::Request request = message::parse_request(text);
  const auto ok = [&] { client.outbox().answer(line_.ok(request.name, request.id_json)); };
  // A line that is no JSON, such as one with NaN, has no name.
  const auto is_odometry = [&] {
    // Also one with a misspelt class or none, or that is no JSON: where odometry is awaited, any.
    const auto has = [&](std::string_view word) { return text.find(word) != text.npos; };
    return request.name.empty()
               ? actions_.add_odometry || has("ODOM") || has("\"left\"") || has("\"gyro\"")
               : request.name.starts_with("ODOM") || request.name == "odometry";
  };
  const auto error = [&](std::string_view code, std::string_view reason) {
    // A program that sends odometry may never read, and its later lines may be right.
    if (client.outbox().waiting_answers() >= kMaxUnreadErrors && is_odometry()) return;
    client.outbox().answer(line_.error(code, reason, request.name, request.id_json));
  };
  const auto if_control = [&](const auto& act) {
    if (role == SocketRole::kControl) {
      act();
    } else {
      error("read-only", "the pose socket takes no such request: use the control socket");
    }
  };
  std::visit(Overloaded{
                 [&](const message::RequestError& wrong) {
                   error(wrong.code, wrong.text);
                   if (role == SocketRole::kControl && actions_.refuse_odometry && is_odometry()) {
                     actions_.refuse_odometry(wrong);
                   }
                 },
                 [&](const message::WatchRequest& watch) {
                   client.watch(watch.classes);
                   ok();
                   // It is published at a change only.
                   const Line& map = newest_[static_cast<std::size_t>(MessageClass::kMap)];
                   if (map && watch.classes.contains(MessageClass::kMap)) {
                     client.outbox().put(MessageClass::kMap, map);
                   }
                 },
                 [&](const message::PollRequest& request_for) {
                   poll(client, request_for.classes);
                   ok();
                 },
                 [&](const message::RelocalizeRequest&) {
                   if_control([&] {
                     actions_.relocalize();
                     ok();
                   });
                 },
                 [&](const message::SetPoseRequest& set_pose) {
                   if_control([&] {
                     if (!actions_.set_pose)
                       return error("unsupported", "this daemon takes no initial pose");
                     if (const auto refusal = actions_.set_pose(set_pose)) {
                       return error(refusal->code, refusal->text);
                     }
                     ok();
                   });
                 },
                 [&](const message::SetMapRequest& set_map) {
                   if_control([&] {
                     if (!actions_.set_map)
                       return error("unsupported", "this daemon takes no other map");
                     const Ticket ticket{client.number(), request.name, request.id_json};
                     if (actions_.set_map(set_map, ticket)) return;
                     error("busy", "other maps are being loaded: wait for the answers");
                   });
                 },
                 [&](const message::OdometryReading& reading) {
                   if_control([&] {
                     if (!actions_.add_odometry) {
                       const message::RequestError wrong{
                           "unsupported", "/odometry/source of the config is not \"socket\""};
                       if (actions_.refuse_odometry) actions_.refuse_odometry(wrong);
                       return error(wrong.code, wrong.text);
                     }
                     // Accepted ODOMETRY gets no answer: it comes at up to 500 Hz.
                     if (actions_.add_odometry(reading, client.fd())) return;
                     error("second-client",
                           "another client's odometry is used: stop one of the two clients");
                   });
                 },
             },
             request.body);
}

void RequestHandler::poll(Client& client, message::ClassSet classes) {
  for (const MessageClass polled : message::kPolled) {
    const Line& newest = newest_[static_cast<std::size_t>(polled)];
    if (newest && classes.contains(polled)) client.outbox().answer(newest);
  }
}

}  // namespace cornerd::daemon
