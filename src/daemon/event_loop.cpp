// SPDX-License-Identifier: MIT
#include "daemon/event_loop.hpp"

#include <sys/epoll.h>

#include <array>
#include <cerrno>
#include <system_error>
#include <utility>

namespace cornerd::daemon {
namespace {

/// A descriptor's number is given again as soon as it is free: `registration` tells the two apart.
epoll_event event_of(int fd, std::uint32_t registration, std::uint32_t events) {
  epoll_event event{};
  event.events = events;
  event.data.u64 = std::uint64_t{registration} << 32 | static_cast<std::uint32_t>(fd);
  return event;
}

}  // namespace

EventLoop::EventLoop() : epoll_(require_fd(::epoll_create1(EPOLL_CLOEXEC), "epoll_create1")) {}

void EventLoop::add(int fd, std::uint32_t events, Handler handler) {
  epoll_event event = event_of(fd, ++newest_, events);
  if (::epoll_ctl(epoll_.get(), EPOLL_CTL_ADD, fd, &event) != 0) {
    throw std::system_error(errno, std::generic_category(), "epoll_ctl");
  }
  registrations_[fd] = {newest_, std::make_shared<const Handler>(std::move(handler))};
}

void EventLoop::change(int fd, std::uint32_t events) {
  epoll_event event = event_of(fd, registrations_.at(fd).number, events);
  ::epoll_ctl(epoll_.get(), EPOLL_CTL_MOD, fd, &event);
}

void EventLoop::remove(int fd) {
  ::epoll_ctl(epoll_.get(), EPOLL_CTL_DEL, fd, nullptr);
  registrations_.erase(fd);
}

void EventLoop::run_once(int timeout_ms) {
  std::array<epoll_event, 32> events;
  const int count = ::epoll_wait(epoll_.get(), events.data(), events.size(), timeout_ms);
  for (int i = 0; i < count; ++i) {
    const epoll_event& event = events[static_cast<std::size_t>(i)];
    const auto found = registrations_.find(static_cast<int>(event.data.u64 & 0xffffffff));
    // A handler before this one may have removed it, and added another of the same number.
    if (found == registrations_.end() || found->second.number != event.data.u64 >> 32) continue;
    const auto handler = found->second.handler;  // lives on where it removes itself
    (*handler)(event.events);
  }
}

void EventLoop::run() {
  running_ = true;
  while (running_) run_once(-1);
}

}  // namespace cornerd::daemon
