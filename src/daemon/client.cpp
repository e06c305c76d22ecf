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

/// The kernel raises this to its minimum of 4,608 bytes: three or four POSE lines.
constexpr int kSendBufferBytes = 1;

/// With more waiting answers, requests stay in the client's own send buffer.
constexpr std::size_t kMaxWaitingAnswers = 16;

}  // namespace

Client::Client(FileDescriptor fd, message::ClassSet watched, std::uint64_t number)
    : fd_(std::move(fd)), number_(number), watched_(watched), input_(message::kMaxRequestBytes) {
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

Client::Input Client::receive(const Handle& handle) {
  // One block per round, so that a client that sends continuously delays no other.
  std::array<char, 16 * 1024> block;
  const ssize_t count = ::recv(fd_.get(), block.data(), block.size(), MSG_DONTWAIT);
  if (count < 0) return errno == EAGAIN || errno == EINTR ? Input::kOpen : Input::kBroken;
  if (count == 0) {
    input_ended_ = true;
    const std::string rest = input_.take_remainder();
    if (!rest.empty()) handle(rest);
    return Input::kOpen;
  }
  input_.feed({block.data(), static_cast<std::size_t>(count)});
  return handle_requests(handle);
}

Client::Input Client::handle_requests(const Handle& handle) {
  while (outbox_.waiting_answers() < kMaxWaitingAnswers) {
    const auto line = input_.next();
    if (!line) break;
    handle(*line);
  }
  return input_.is_too_long() ? Input::kTooLong : Input::kOpen;
}

std::uint32_t Client::wanted_events() const {
  const bool listens = !input_ended_ && !has_requests();
  // Requests that wait are handled as soon as there is room for their answers.
  return (listens ? EPOLLIN : 0u) | (blocked_ || has_requests() ? EPOLLOUT : 0u);
}

}  // namespace cornerd::daemon
