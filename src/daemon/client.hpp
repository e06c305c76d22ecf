// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <functional>
#include <string_view>

#include "daemon/line_splitter.hpp"
#include "daemon/outbox.hpp"
#include "daemon/require_fd.hpp"
#include "message/request.hpp"

namespace cornerd::daemon {

/// One connection: reads and writes lines without blocking.
class Client {
 public:
  /// Makes the socket's send buffer small, so that the kernel holds few stale messages.
  /// `number`: of no other client of the server.
  Client(FileDescriptor fd, message::ClassSet watched, std::uint64_t number = 0);

  int fd() const { return fd_.get(); }
  std::uint64_t number() const { return number_; }
  Outbox& outbox() { return outbox_; }
  const Outbox& outbox() const { return outbox_; }
  void watch(message::ClassSet classes) { watched_ = classes; }
  bool watches(message::MessageClass message_class) const {
    return watched_.contains(message_class);
  }

  /// False if the connection is broken.
  [[nodiscard]] bool send();
  enum class Input : std::uint8_t { kOpen, kTooLong, kBroken };
  using Handle = std::function<void(std::string_view line)>;
  /// Reads and handles requests until too many answers wait.
  [[nodiscard]] Input receive(const Handle& handle);
  /// Handles requests that receive() left.
  [[nodiscard]] Input handle_requests(const Handle& handle);
  /// Requests wait to be handled.
  bool has_requests() const { return input_.has_line(); }
  /// The outbox waits until the client reads.
  bool is_blocked() const { return blocked_; }

  /// Events for epoll.
  std::uint32_t wanted_events() const;

 private:
  FileDescriptor fd_;
  std::uint64_t number_;
  message::ClassSet watched_;
  LineSplitter input_;
  Outbox outbox_;
  bool blocked_ = false;
  bool input_ended_ = false;  ///< the client closed its sending side; it may still read
};

}  // namespace cornerd::daemon
