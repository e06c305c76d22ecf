// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <functional>
#include <string_view>

#include "daemon/require_fd.hpp"
#include "daemon/line_splitter.hpp"
#include "daemon/outbox.hpp"
#include "message/request.hpp"

namespace cornerd::daemon {

/// One connection: lines in, lines out, neither ever waited for.
class Client {
 public:
  /// Makes the socket's send buffer small, so that the kernel holds little that is stale.
  Client(FileDescriptor fd, message::ClassSet watched);

  int fd() const { return fd_.get(); }
  Outbox& outbox() { return outbox_; }
  const Outbox& outbox() const { return outbox_; }
  void watch(message::ClassSet classes) { watched_ = classes; }
  bool watches(message::MessageClass message_class) const {
    return watched_.contains(message_class);
  }

  /// False where the connection is at its end.
  [[nodiscard]] bool send();
  enum class Input : std::uint8_t { kOpen, kTooLong, kBroken };
  using Handle = std::function<void(std::string_view line)>;
  /// What the client has sent, as far as its answers find room.
  [[nodiscard]] Input receive(const Handle& handle);
  /// The rest of it, once there is room again.
  [[nodiscard]] Input handle_requests(const Handle& handle);
  /// It has sent more than was handled.
  bool has_requests() const { return input_.has_line(); }
  /// Its answers wait for it to read.
  bool is_blocked() const { return blocked_; }

  /// What epoll has to watch for now.
  std::uint32_t wanted_events() const;

 private:
  FileDescriptor fd_;
  message::ClassSet watched_;
  LineSplitter input_;
  Outbox outbox_;
  bool blocked_ = false;      ///< the outbox waits for the client to read
  bool input_ended_ = false;  ///< the client sends no more; it may still read
};

}  // namespace cornerd::daemon
