// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <list>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "daemon/client.hpp"
#include "daemon/event_loop.hpp"
#include "daemon/request_handler.hpp"
#include "daemon/systemd.hpp"
#include "daemon/unix_listener.hpp"
#include "message/line_writer.hpp"
#include "message/request.hpp"

namespace cornerd::daemon {

/// Serves the clients of both sockets. Runs in the thread of `loop`, which must outlive it.
class MessageServer {
 public:
  /// Of both sockets.
  static constexpr std::size_t kMaxClients = 32;
  /// Clients that the control socket always accepts. Any user may connect to the pose socket, and
  /// must not lock out the robot's own programs.
  static constexpr std::size_t kReservedControlClients = 4;

  MessageServer(EventLoop& loop, std::string_view version, ControlActions actions);
  ~MessageServer();
  MessageServer(const MessageServer&) = delete;
  MessageServer& operator=(const MessageServer&) = delete;

  /// Throws std::runtime_error if the socket cannot be opened.
  void listen(const std::filesystem::path& path, SocketRole role);
  /// On a socket from the service manager.
  void listen(InheritedSocket socket, SocketRole role);

  /// Recreates sockets whose file was removed. `log` gets one line per restored socket and one line
  /// for the first failure.
  void restore_sockets(const std::function<void(const std::string& line)>& log);

  /// Sends to all clients that watch the class. Keeps the newest line for POLL and new clients.
  void publish(message::MessageClass message_class, const Line& line);
  void publish(message::MessageClass message_class, std::string_view line) {
    publish(message_class, std::make_shared<const std::string>(line));
  }
  bool is_watched(message::MessageClass message_class) const;

  /// Answers the request of a Ticket: OK, or ERROR. Nothing if the client has left.
  void answer_later(const Ticket& ticket, const std::optional<message::RequestError>& error);

  std::size_t clients() const;
  /// Messages lost by slow clients.
  std::uint64_t dropped() const;

 private:
  struct Socket {
    Socket(const std::filesystem::path& path, mode_t mode, SocketRole its_role)
        : listener(std::make_unique<UnixListener>(path, mode)), role(its_role) {}
    Socket(const std::filesystem::path& path, FileDescriptor inherited, SocketRole its_role)
        : listener(std::make_unique<UnixListener>(path, std::move(inherited))), role(its_role) {}
    std::unique_ptr<UnixListener> listener;
    SocketRole role;
    bool restore_failed = false;
    std::list<Client> clients;
  };
  using ClientIterator = std::list<Client>::iterator;

  void serve(Socket& socket);
  void accept_clients(Socket& socket);
  /// Disconnects the newest client of the pose socket for a reserved control client. False if no
  /// place becomes free.
  bool evict_pose_client(const Socket& socket);
  void add_client(Socket& socket, FileDescriptor fd);
  /// Sends an ERROR and disconnects.
  void reject(FileDescriptor fd, std::string_view code, std::string_view reason);
  void handle_events(Socket& socket, ClientIterator client, std::uint32_t events);
  /// False if the client was removed.
  bool handle_input_result(Socket& socket, ClientIterator client, Client::Input input);
  /// Sends waiting lines. False if the connection was broken and the client removed.
  bool send_or_remove(Socket& socket, ClientIterator client);
  void remove(Socket& socket, ClientIterator client);

  EventLoop& loop_;
  message::LineWriter line_;
  std::list<Socket> sockets_;
  NewestLines newest_;
  RequestHandler handler_;
  std::uint64_t accepted_ = 0;  ///< clients
  std::uint64_t dropped_by_closed_ = 0;
};

}  // namespace cornerd::daemon
