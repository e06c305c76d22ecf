// SPDX-License-Identifier: MIT
#pragma once

#include <condition_variable>
#include <cstddef>
#include <deque>
#include <filesystem>
#include <functional>
#include <mutex>
#include <string>
#include <thread>

#include "client/request.hpp"

namespace cornerd::mqtt {

/// Sends requests to the control socket in a thread of its own, since SET_MAP takes seconds.
class ControlQueue {
 public:
  using Done = std::function<void(const client::Answer&)>;
  /// Requests that wait. More are refused: nobody on the network keeps the daemon busy.
  static constexpr std::size_t kMaxWaiting = 4;

  explicit ControlQueue(std::filesystem::path socket);
  ~ControlQueue();
  ControlQueue(const ControlQueue&) = delete;
  ControlQueue& operator=(const ControlQueue&) = delete;

  /// `line`: with its newline. False if too many wait; else deliver() calls `done` later.
  bool ask(std::string line, Done done);
  /// Calls `done` of what has been answered.
  void deliver();

 private:
  struct Job {
    std::string line;
    Done done;
    client::Answer answer = {};
  };
  void work(const std::stop_token& stop);

  std::filesystem::path socket_;
  std::mutex mutex_;
  std::condition_variable_any changed_;
  std::deque<Job> waiting_;
  std::deque<Job> answered_;
  std::jthread thread_;
};

}  // namespace cornerd::mqtt
