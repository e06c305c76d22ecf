// SPDX-License-Identifier: MIT
#include "tool/monitor/signal_queue.hpp"

#include <sys/signalfd.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <string>

#include "tool/command_line/failure.hpp"

namespace cornerd::tool {

SignalQueue::SignalQueue(std::initializer_list<int> signals) {
  sigset_t set;
  sigemptyset(&set);
  for (const int signal : signals) sigaddset(&set, signal);
  pthread_sigmask(SIG_BLOCK, &set, &before_);
  fd_ = ::signalfd(-1, &set, SFD_NONBLOCK | SFD_CLOEXEC);
  if (fd_ < 0) {
    pthread_sigmask(SIG_SETMASK, &before_, nullptr);
    throw Failure(std::string("signalfd: ") + std::strerror(errno));
  }
}

SignalQueue::~SignalQueue() {
  // Pending signals must not reach the old handlers.
  while (take() != 0) {
  }
  ::close(fd_);
  pthread_sigmask(SIG_SETMASK, &before_, nullptr);
}

int SignalQueue::take() const {
  signalfd_siginfo signal{};
  return ::read(fd_, &signal, sizeof signal) == sizeof signal ? static_cast<int>(signal.ssi_signo)
                                                              : 0;
}

}  // namespace cornerd::tool
