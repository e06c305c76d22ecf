// SPDX-License-Identifier: MIT
#include "daemon/event_loop.hpp"

#include <pthread.h>
#include <signal.h>
#include <sys/epoll.h>
#include <sys/signalfd.h>
#include <sys/timerfd.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdint>
#include <initializer_list>
#include <system_error>
#include <utility>

#include "core/types.hpp"
#include "daemon/posix_clock.hpp"

namespace cornerd::daemon {
namespace {

/// The kernel reuses descriptor numbers; `registration` distinguishes their owners.
epoll_event event_of(int fd, std::uint32_t registration, std::uint32_t events) {
  epoll_event event{};
  event.events = events;
  event.data.u64 = std::uint64_t{registration} << 32 | static_cast<std::uint32_t>(fd);
  return event;
}

sigset_t block_signals(std::initializer_list<int> numbers) {
  sigset_t signals;
  ::sigemptyset(&signals);
  for (const int number : numbers) ::sigaddset(&signals, number);
  ::pthread_sigmask(SIG_BLOCK, &signals, nullptr);
  return signals;
}

}  // namespace

EventLoop::EventLoop() : epoll_(require_fd(::epoll_create1(EPOLL_CLOEXEC), "epoll_create1")) {}

void EventLoop::add(int fd, std::uint32_t events, Handler handler) {
  epoll_event event = event_of(fd, ++newest_, events);
  if (::epoll_ctl(epoll_.get(), EPOLL_CTL_ADD, fd, &event) != 0) {
    throw std::system_error(errno, std::generic_category(), "epoll_ctl");
  }
  registrations_[fd] = {newest_, events, std::make_shared<const Handler>(std::move(handler))};
}

void EventLoop::change(int fd, std::uint32_t events) {
  Registration& registration = registrations_.at(fd);
  if (std::exchange(registration.events, events) == events) return;
  epoll_event event = event_of(fd, registration.number, events);
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
    // An earlier handler of this round may have replaced the descriptor.
    if (found == registrations_.end() || found->second.number != event.data.u64 >> 32) continue;
    const auto handler = found->second.handler;  // keeps a handler alive that removes itself
    (*handler)(event.events);
  }
}

void EventLoop::run() {
  running_ = true;
  while (running_) run_once(-1);
}

PeriodicTimer::PeriodicTimer(std::chrono::nanoseconds period)
    : period_(period),
      fd_(require_fd(::timerfd_create(CLOCK_MONOTONIC, TFD_NONBLOCK | TFD_CLOEXEC),
                     "timerfd_create")),
      due_(monotonic_ns()) {
  const auto as_timespec = [](std::chrono::nanoseconds duration) {
    return timespec{static_cast<time_t>(duration.count() / core::kNsPerSecond),
                    static_cast<long>(duration.count() % core::kNsPerSecond)};
  };
  const itimerspec times{as_timespec(period), as_timespec(due_ + period)};
  ::timerfd_settime(fd_.get(), TFD_TIMER_ABSTIME, &times, nullptr);
}

std::chrono::nanoseconds PeriodicTimer::acknowledge() {
  std::uint64_t expirations = 0;
  if (::read(fd_.get(), &expirations, sizeof(expirations)) != sizeof(expirations)) return {};
  due_ += static_cast<std::int64_t>(expirations) * period_;
  return std::chrono::nanoseconds(monotonic_ns()) - due_;
}

void block_reloads() { block_signals({SIGHUP}); }

Signals::Signals() {
  const sigset_t signals = block_signals({SIGTERM, SIGINT, SIGHUP});
  fd_ = require_fd(::signalfd(-1, &signals, SFD_NONBLOCK | SFD_CLOEXEC), "signalfd");
}

int Signals::take() const {
  signalfd_siginfo info{};
  if (::read(fd_.get(), &info, sizeof(info)) != sizeof(info)) return 0;
  return static_cast<int>(info.ssi_signo);
}

}  // namespace cornerd::daemon
