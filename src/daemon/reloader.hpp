// SPDX-License-Identifier: MIT
#pragma once

#include <deque>
#include <optional>
#include <string>
#include <thread>

#include "daemon/map_loader.hpp"
#include "daemon/request_handler.hpp"
#include "daemon/require_fd.hpp"
#include "message/request.hpp"

namespace cornerd::daemon {

/// Loads config and map in a thread of its own and of less priority, because the catalogue of a
/// large map takes seconds.
class Reloader {
 public:
  /// A SET_MAP and who waits for its answer, or a lidar that has said which it is; on SIGHUP
  /// neither.
  struct Job {
    std::optional<message::SetMapRequest> set_map = {};
    Ticket ticket = {};
    const drivers::LidarModel* model = nullptr;

    bool is_reload() const { return !set_map && model == nullptr; }
  };
  struct Outcome {
    Job job;
    Loaded loaded;
    std::string error;  ///< one line; empty on success
  };

  /// Throws std::system_error.
  explicit Reloader(MapLoader loader);
  /// Ends the process where a load, which cannot be interrupted, goes on for more than a second.
  ~Reloader();
  Reloader(const Reloader&) = delete;
  Reloader& operator=(const Reloader&) = delete;

  /// Loads after the jobs that wait. False if too many wait.
  bool start(Job job);

  /// Readable when there is an outcome.
  int event_fd() const { return done_.get(); }
  /// The outcome of the finished load.
  Outcome take();

 private:
  void start_next();
  void run();

  MapLoader loader_;  ///< owned by the thread until done_ is readable, as outcome_ is
  FileDescriptor done_;
  std::deque<Job> waiting_;
  bool is_loading_ = false;
  Outcome outcome_;
  std::jthread thread_;
};

}  // namespace cornerd::daemon
