// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <utility>

#include "daemon/client.hpp"
#include "daemon/outbox.hpp"
#include "message/line_writer.hpp"
#include "message/request.hpp"

namespace cornerd::daemon {

/// The pose socket is read-only; the control socket takes requests that change the estimate.
enum class SocketRole : std::uint8_t { kPose, kControl };

/// A request whose answer takes time, and the client that waits for it.
struct Ticket {
  std::uint64_t client = 0;  ///< Client::number()
  std::string request;
  std::string id_json;
};

/// The newest line of each class; null before the first.
using NewestLines = std::array<Line, message::kMessageClasses>;

/// Handlers of control requests. A request with an empty handler is refused as unsupported.
struct ControlActions {
  std::function<void()> relocalize;
  /// Gives the reason for a refusal.
  std::function<std::optional<message::RequestError>(const message::SetPoseRequest&)> set_pose = {};
  /// Returns false if the client gets an ERROR because another client's odometry is used. That
  /// happens once per connection, so that answers do not fill the queue of a client that never
  /// reads. `connection`: identifies the client.
  std::function<bool(const message::OdometryReading&, int connection)> add_odometry = {};
  /// A connection was closed; optional.
  std::function<void(int connection)> disconnect = {};
  /// The answer follows with MessageServer::answer_later(). False if too many requests wait.
  std::function<bool(const message::SetMapRequest&, const Ticket&)> set_map = {};
  /// An ODOMETRY line could not be read; optional.
  std::function<void(const message::RequestError&)> refuse_odometry = {};
};

/// Acts on the requests of clients and puts the answers into their outboxes.
class RequestHandler {
 public:
  /// `newest` must outlive this.
  RequestHandler(ControlActions actions, const NewestLines& newest)
      : actions_(std::move(actions)), newest_(newest) {}

  void handle(Client& client, SocketRole role, std::string_view line);
  void disconnect(const Client& client) const {
    if (actions_.disconnect) actions_.disconnect(client.fd());
  }

 private:
  void poll(Client& client, message::ClassSet classes);

  const ControlActions actions_;
  const NewestLines& newest_;
  message::LineWriter line_;
};

}  // namespace cornerd::daemon
