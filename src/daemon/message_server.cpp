// SPDX-License-Identifier: MIT
#include "daemon/message_server.hpp"

#include <sys/epoll.h>
#include <unistd.h>

#include <algorithm>
#include <exception>
#include <iterator>
#include <utility>

#include "daemon/unix_listener.hpp"

namespace cornerd::daemon {
namespace {

using message::MessageClass;

/// Every user may read poses; control requests need membership of the daemon's group.
constexpr mode_t kPoseMode = 0666;
constexpr mode_t kControlMode = 0660;

/// Why clients cannot connect to the socket, and what to do; empty if the daemon mends it.
std::string_view complaint(UnixListener::File file) {
  switch (file) {
    case UnixListener::File::kReplaced:
      return ": is no longer the socket of this daemon, whose clients connect to something else: "
             "remove it, and the daemon makes its own again";
    case UnixListener::File::kClosed:
      return ": its mode was changed, and clients that could connect cannot: remove it, and the "
             "daemon makes it again";
    default:
      return {};
  }
}

mode_t mode_of(SocketRole role) { return role == SocketRole::kPose ? kPoseMode : kControlMode; }

/// The classes before the first WATCH.
message::ClassSet default_classes(SocketRole role) {
  message::ClassSet classes;
  if (role == SocketRole::kPose) {
    classes.insert(MessageClass::kPose);
    classes.insert(MessageClass::kStatus);
  }
  return classes;
}

}  // namespace

MessageServer::MessageServer(EventLoop& loop, std::string_view version, ControlActions actions)
    : loop_(loop), handler_(std::move(actions), newest_) {
  publish(MessageClass::kVersion, line_.version("cornerd", version));
}

MessageServer::~MessageServer() {
  for (Socket& socket : sockets_) {
    loop_.remove(socket.listener->fd());
    while (!socket.clients.empty()) remove(socket, socket.clients.begin());
  }
}

void MessageServer::listen(const std::filesystem::path& path, SocketRole role) {
  sockets_.emplace_back(path, mode_of(role), role);
  serve(sockets_.back());
}

void MessageServer::listen(InheritedSocket socket, SocketRole role) {
  sockets_.emplace_back(socket.path, std::move(socket.fd), role);
  serve(sockets_.back());
}

void MessageServer::serve(Socket& socket) {
  loop_.add(socket.listener->fd(), EPOLLIN,
            [this, &socket](std::uint32_t /*events*/) { accept_clients(socket); });
}

void MessageServer::restore_sockets(const std::function<void(const std::string& line)>& log) {
  for (Socket& socket : sockets_) {
    const UnixListener::File file = socket.listener->file();
    const std::filesystem::path path = socket.listener->path();
    if (file == UnixListener::File::kOwn) {
      socket.restore_failed = false;
      continue;
    }
    if (const std::string_view text = complaint(file); !text.empty()) {
      if (!std::exchange(socket.restore_failed, true)) log(path.string().append(text));
      continue;
    }
    try {
      auto listener = std::make_unique<UnixListener>(path, mode_of(socket.role));
      loop_.remove(socket.listener->fd());
      socket.listener = std::move(listener);
      serve(socket);
      log(path.string() + ": the socket file was removed; recreated it");
    } catch (const std::exception& error) {
      if (!std::exchange(socket.restore_failed, true)) log(error.what());
    }
  }
}

void MessageServer::accept_clients(Socket& socket) {
  FileDescriptor fd = socket.listener->accept();
  if (!fd.is_open()) return;
  if (socket.role == SocketRole::kControl) {
    // Checked here too because the mode of the socket file may have been changed.
    const std::optional<Peer> peer = peer_of(fd.get());
    if (!peer || !belongs_to(*peer, socket.listener->group(), ::geteuid())) {
      return reject(std::move(fd), "forbidden",
                    "the control socket is for members of its group: add this user to it");
    }
  }
  if (clients() >= kMaxClients && !evict_pose_client(socket)) {
    return reject(std::move(fd), "too-many-clients",
                  "at most 32 clients are served: close other connections");
  }
  add_client(socket, std::move(fd));
}

bool MessageServer::evict_pose_client(const Socket& socket) {
  if (socket.role != SocketRole::kControl || socket.clients.size() >= kReservedControlClients)
    return false;
  for (Socket& other : sockets_) {
    if (other.role != SocketRole::kPose || other.clients.empty()) continue;
    const ClientIterator newest = std::prev(other.clients.end());
    newest->outbox().answer(
        line_.error("too-many-clients", "disconnected to make room for a control client", "", ""));
    static_cast<void>(newest->send());
    remove(other, newest);
    return true;
  }
  return false;
}

void MessageServer::reject(FileDescriptor fd, std::string_view code, std::string_view reason) {
  Client client(std::move(fd), {});
  client.outbox().answer(line_.error(code, reason, "", ""));
  static_cast<void>(client.send());
}

void MessageServer::add_client(Socket& socket, FileDescriptor fd) {
  const ClientIterator client = socket.clients.emplace(socket.clients.end(), std::move(fd),
                                                       default_classes(socket.role), ++accepted_);
  client->outbox().answer(newest_[static_cast<std::size_t>(MessageClass::kVersion)]);
  const Line& status = newest_[static_cast<std::size_t>(MessageClass::kStatus)];
  if (client->watches(MessageClass::kStatus) && status) {
    client->outbox().put(MessageClass::kStatus, status);
  }
  loop_.add(client->fd(), EPOLLIN, [this, &socket, client](std::uint32_t events) {
    handle_events(socket, client, events);
  });
  send_or_remove(socket, client);
}

void MessageServer::handle_events(Socket& socket, ClientIterator client, std::uint32_t events) {
  const auto handle = [&](std::string_view line) { handler_.handle(*client, socket.role, line); };
  if (events & EPOLLIN) {
    if (!handle_input_result(socket, client, client->receive(handle))) return;
  } else if (events & (EPOLLHUP | EPOLLERR)) {
    return remove(socket, client);
  }
  // Sending answers makes room to handle further requests.
  while (send_or_remove(socket, client) && client->has_requests() && !client->is_blocked()) {
    if (!handle_input_result(socket, client, client->handle_requests(handle))) return;
  }
}

bool MessageServer::handle_input_result(Socket& socket, ClientIterator client,
                                        Client::Input input) {
  if (input == Client::Input::kOpen) return true;
  if (input == Client::Input::kTooLong) {
    client->outbox().answer(line_.error("too-long", "the line is longer than 64 KiB", "", ""));
    static_cast<void>(client->send());
  }
  remove(socket, client);
  return false;
}

bool MessageServer::send_or_remove(Socket& socket, ClientIterator client) {
  if (!client->send()) {
    remove(socket, client);
    return false;
  }
  loop_.change(client->fd(), client->wanted_events());
  return true;
}

void MessageServer::remove(Socket& socket, ClientIterator client) {
  dropped_by_closed_ += client->outbox().dropped();
  handler_.disconnect(*client);
  loop_.remove(client->fd());
  socket.clients.erase(client);
}

void MessageServer::answer_later(const Ticket& ticket,
                                 const std::optional<message::RequestError>& error) {
  for (Socket& socket : sockets_) {
    const auto client =
        std::find_if(socket.clients.begin(), socket.clients.end(),
                     [&](const Client& one) { return one.number() == ticket.client; });
    if (client == socket.clients.end()) continue;
    client->outbox().answer(
        error ? line_.error(error->code, error->text, ticket.request, ticket.id_json)
              : line_.ok(ticket.request, ticket.id_json));
    send_or_remove(socket, client);
    return;
  }
}

void MessageServer::publish(MessageClass message_class, const Line& line) {
  newest_[static_cast<std::size_t>(message_class)] = line;
  for (Socket& socket : sockets_) {
    for (auto next = socket.clients.begin(); next != socket.clients.end();) {
      const ClientIterator client = next++;
      if (!client->watches(message_class)) continue;
      client->outbox().put(message_class, line);
      send_or_remove(socket, client);
    }
  }
}

bool MessageServer::is_watched(MessageClass message_class) const {
  for (const Socket& socket : sockets_) {
    for (const Client& client : socket.clients) {
      if (client.watches(message_class)) return true;
    }
  }
  return false;
}

std::size_t MessageServer::clients() const {
  std::size_t count = 0;
  for (const Socket& socket : sockets_) count += socket.clients.size();
  return count;
}

std::uint64_t MessageServer::dropped() const {
  std::uint64_t count = dropped_by_closed_;
  for (const Socket& socket : sockets_) {
    for (const Client& client : socket.clients) count += client.outbox().dropped();
  }
  return count;
}

}  // namespace cornerd::daemon
