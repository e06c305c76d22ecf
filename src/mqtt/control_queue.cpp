// SPDX-License-Identifier: MIT
#include "mqtt/control_queue.hpp"

#include <chrono>
#include <utility>

namespace cornerd::mqtt {

namespace {

/// SET_MAP is answered when the map is loaded.
constexpr std::chrono::seconds kAnswerTime{20};

}  // namespace

ControlQueue::ControlQueue(std::filesystem::path socket)
    : socket_(std::move(socket)), thread_([this](const std::stop_token& stop) { work(stop); }) {}

ControlQueue::~ControlQueue() { thread_.request_stop(); }

bool ControlQueue::ask(std::string line, Done done) {
  const std::lock_guard lock(mutex_);
  if (waiting_.size() >= kMaxWaiting) return false;
  waiting_.push_back({std::move(line), std::move(done)});
  changed_.notify_one();
  return true;
}

void ControlQueue::deliver() {
  std::deque<Job> answered;
  {
    const std::lock_guard lock(mutex_);
    answered.swap(answered_);
  }
  for (const Job& job : answered) job.done(job.answer);
}

void ControlQueue::work(const std::stop_token& stop) {
  std::unique_lock lock(mutex_);
  while (changed_.wait(lock, stop, [this] { return !waiting_.empty(); })) {
    Job job = std::move(waiting_.front());
    waiting_.pop_front();
    lock.unlock();
    job.answer = client::ask(socket_, job.line, kAnswerTime);
    lock.lock();
    answered_.push_back(std::move(job));
  }
}

}  // namespace cornerd::mqtt
