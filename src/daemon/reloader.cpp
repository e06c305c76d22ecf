// SPDX-License-Identifier: MIT
#include "daemon/reloader.hpp"

#include <poll.h>
#include <pthread.h>
#include <sys/eventfd.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <exception>
#include <new>
#include <utility>

namespace cornerd::daemon {
namespace {

/// Bounds the memory that a client's requests take.
constexpr std::size_t kMaxWaiting = 8;
/// The localizer's thread comes first on a board with one core: nine times as much of it, sched(7).
constexpr int kNiceness = 10;
/// A large map may take longer than a service manager waits.
constexpr int kMaxWait_ms = 500;

}  // namespace

Reloader::Reloader(MapLoader loader)
    : loader_(std::move(loader)),
      done_(require_fd(::eventfd(0, EFD_NONBLOCK | EFD_CLOEXEC), "eventfd")) {}

Reloader::~Reloader() {
  if (!is_loading_) return;
  pollfd done{done_.get(), POLLIN, 0};
  if (::poll(&done, 1, kMaxWait_ms) <= 0) std::_Exit(EXIT_SUCCESS);
}

bool Reloader::start(Job job) {
  // One reload after the last signal has seen all changes of the files.
  if (job.is_reload() && !waiting_.empty() && waiting_.back().is_reload()) return true;
  if (job.set_map && waiting_.size() >= kMaxWaiting) return false;
  waiting_.push_back(std::move(job));
  if (!is_loading_) start_next();
  return true;
}

void Reloader::start_next() {
  outcome_ = {std::move(waiting_.front()), {}, {}};
  waiting_.pop_front();
  is_loading_ = true;
  thread_ = std::jthread([this] { run(); });
}

void Reloader::run() {
  ::pthread_setname_np(::pthread_self(), "reloader");
  ::setpriority(PRIO_PROCESS, static_cast<id_t>(::gettid()), kNiceness);
  try {
    const Job& job = outcome_.job;
    outcome_.loaded = job.set_map ? loader_.load(*job.set_map)
                      : job.model ? loader_.load(*job.model)
                                  : loader_.load();
  } catch (const std::bad_alloc&) {
    outcome_.error = "the map needs more memory than there is: fewer walls, or `ulimit -v`";
  } catch (const std::exception& error) {
    outcome_.error = error.what();
  }
  ::eventfd_write(done_.get(), 1);
}

Reloader::Outcome Reloader::take() {
  eventfd_t count = 0;
  ::eventfd_read(done_.get(), &count);
  thread_.join();
  is_loading_ = false;
  Outcome outcome = std::exchange(outcome_, {});
  if (!waiting_.empty()) start_next();
  return outcome;
}

}  // namespace cornerd::daemon
