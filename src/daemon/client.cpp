// SPDX-License-Identifier: MIT
#include "daemon/client.hpp"

#include <sys/epoll.h>
#include <sys/socket.h>

#include <array>
#include <cerrno>
#include <string>
#include <utility>

namespace cornerd::daemon {
namespace {

/// The kernel raises this to its least, 4,608 bytes: three or four poses.
constexpr int kSendBufferBytes = 1;

/// Requests of a client that does not read their answers wait in its own send buffer.
constexpr std::size_t kMaxWaitingAnswers = 64;

}  // namespace

Client::Client(FileDescriptor fd, message::ClassSet watched)
    : fd_(std::move(fd)), watched_(watched), input_(message::kMaxRequestBytes) {
  ::setsockopt(fd_.get(), SOL_SOCKET, SO_SNDBUF, &kSendBufferBytes, sizeof(kSendBufferBytes));
}

bool Client::send() {
  const Outbox::Result result = outbox_.flush([this](std::string_view bytes) -> std::ptrdiff_t {
    const ssize_t sent = ::send(fd_.get(), bytes.data(), bytes.size(), MSG_NOSIGNAL | MSG_DONTWAIT);
    if (sent >= 0) return sent;
    return errno == EAGAIN || errno == EINTR ? 0 : -1;
  });
  blocked_ = result == Outbox::Result::kBlocked;
  return result != Outbox::Result::kBroken;
}

Client::Input Client::receive(const std::function<void(std::string_view line)>& handle) {
  // One block a round: a client that never stops sending delays nobody.
  std::array<char, 16 * 1024> block;
  const ssize_t count = ::recv(fd_.get(), block.data(), block.size(), MSG_DONTWAIT);
  if (count < 0) return errno == EAGAIN || errno == EINTR ? Input::kOpen : Input::kBroken;
  if (count == 0) {
    input_ended_ = true;
    const std::string rest = input_.take_rest();
    if (!rest.empty()) handle(rest);
    return Input::kOpen;
  }
  const bool understood = input_.feed({block.data(), static_cast<std::size_t>(count)}, handle);
  return understood ? Input::kOpen : Input::kTooLong;
}

bool Client::accepts_requests() const {
  return !input_ended_ && outbox_.waiting_answers() < kMaxWaitingAnswers;
}

std::uint32_t Client::wanted_events() const {
  return (accepts_requests() ? EPOLLIN : 0u) | (blocked_ ? EPOLLOUT : 0u);
}

}  // namespace cornerd::daemon
