// SPDX-License-Identifier: MIT
#include "daemon/reloader.hpp"

#include <sys/eventfd.h>

#include <exception>
#include <utility>

namespace cornerd::daemon {

Reloader::Reloader(Load load)
    : load_(std::move(load)),
      done_(require_fd(::eventfd(0, EFD_NONBLOCK | EFD_CLOEXEC), "eventfd")) {}

void Reloader::start() {
  reload_pending_ = is_loading_;
  if (is_loading_) return;
  is_loading_ = true;
  thread_ = std::jthread([this] { run(); });
}

void Reloader::run() {
  try {
    outcome_ = {load_(), {}};
  } catch (const std::exception& error) {
    outcome_ = {{}, error.what()};
  }
  ::eventfd_write(done_.get(), 1);
}

Reloader::Outcome Reloader::take() {
  eventfd_t count = 0;
  ::eventfd_read(done_.get(), &count);
  thread_.join();
  is_loading_ = false;
  Outcome outcome = std::exchange(outcome_, {});
  if (std::exchange(reload_pending_, false)) start();
  return outcome;
}

}  // namespace cornerd::daemon
