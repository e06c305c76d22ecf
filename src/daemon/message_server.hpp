// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <list>
#include <memory>
#include <string>
#include <string_view>
#include <utility>

#include "daemon/client.hpp"
#include "daemon/event_loop.hpp"
#include "daemon/systemd.hpp"
#include "daemon/unix_listener.hpp"
#include "message/line_writer.hpp"
#include "message/request.hpp"

namespace cornerd::daemon {

/// What a socket is for. Whoever may connect to the pose socket learns where the robot is; whoever
/// may connect to the control socket can also change what the daemon believes.
enum class SocketRole : std::uint8_t { kPose, kControl };

/// What a client of the control socket may change. An empty one is refused as unsupported.
struct ControlActions {
  std::function<void()> relocalize;
  std::function<void(const message::SetPoseRequest&)> set_pose = {};
  /// False where the client is to be told that another's is taken: once, as one that does not read
  /// is no longer heard when its answers fill its queue. `connection`: that which it came by.
  std::function<bool(const message::OdometryReading&, int connection)> add_odometry = {};
  /// A connection has ended; optional.
  std::function<void(int connection)> disconnect = {};
};

/// The clients of both sockets: sends them what they watch, answers what they ask. One thread, that
/// of the loop, which must outlive it.
class MessageServer {
 public:
  /// On both sockets together.
  static constexpr std::size_t kMaxClients = 32;
  /// So many find room on the control socket though others have taken it all: anybody may listen
  /// for poses, and is not to keep the robot's own programs out.
  static constexpr std::size_t kReservedControlClients = 4;

  MessageServer(EventLoop& loop, std::string version, ControlActions actions);
  ~MessageServer();
  MessageServer(const MessageServer&) = delete;
  MessageServer& operator=(const MessageServer&) = delete;

  /// Throws std::runtime_error where the socket cannot be had.
  void listen(const std::filesystem::path& path, SocketRole role);
  /// On a socket that is there already.
  void listen(InheritedSocket socket, SocketRole role);

  /// Makes those again whose file somebody has removed, and says so; what it cannot make, once.
  void restore_sockets(const std::function<void(const std::string& line)>& tell);

  /// To all that watch the class. The newest of each class is kept for POLL and newcomers.
  void publish(message::MessageClass message_class, std::string_view line);
  bool is_watched(message::MessageClass message_class) const;

  std::size_t clients() const;
  /// Messages that clients lost because they did not read.
  std::uint64_t dropped() const;

 private:
  struct Socket {
    Socket(const std::filesystem::path& path, mode_t mode, SocketRole its_role)
        : listener(std::make_unique<UnixListener>(path, mode)), role(its_role) {}
    Socket(const std::filesystem::path& path, FileDescriptor inherited, SocketRole its_role)
        : listener(std::make_unique<UnixListener>(path, std::move(inherited))), role(its_role) {}
    std::unique_ptr<UnixListener> listener;
    SocketRole role;
    bool restore_failed = false;  ///< its file is gone, and cannot be made again
    std::list<Client> clients;
  };
  using ClientIterator = std::list<Client>::iterator;

  void serve(Socket& socket);
  void accept_clients(Socket& socket);
  /// Sends the newest client of the pose socket away where one that comes may have its place.
  bool evict_pose_client(const Socket& socket);
  void add_client(Socket& socket, FileDescriptor fd);
  /// Tells a client why, and no more.
  void reject(FileDescriptor fd, std::string_view code, std::string_view reason);
  void handle_events(Socket& socket, ClientIterator client, std::uint32_t events);
  /// False where the client had to be removed.
  bool handle_input_result(Socket& socket, ClientIterator client, Client::Input input);
  /// Sends what waits; removes the client where it is gone. False where it was.
  bool send_or_remove(Socket& socket, ClientIterator client);
  void remove(Socket& socket, ClientIterator client);
  void answer(Client& client, SocketRole role, std::string_view line);
  void answer_poll(Client& client);

  EventLoop& loop_;
  const std::string version_;
  const ControlActions actions_;
  message::LineWriter line_;
  std::list<Socket> sockets_;
  std::array<std::string, 8> newest_;  ///< by class
  std::uint64_t dropped_by_closed_ = 0;
};

}  // namespace cornerd::daemon
