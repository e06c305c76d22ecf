// SPDX-License-Identifier: MIT
#include "daemon/repeated_log.hpp"

#include "core/types.hpp"

namespace cornerd::daemon {
namespace {

constexpr std::int64_t kPeriodNs = 10 * core::kNsPerSecond;

}  // namespace

void RepeatedLog::say(const std::string& text, std::int64_t now_ns) {
  tick(now_ns);
  if (said_ns_ && now_ns - *said_ns_ < kPeriodNs) {
    ++held_back_;
    last_ = text;
    return;
  }
  said_ns_ = now_ns;
  log(level_, std::string(what_) + ": " + text);
}

void RepeatedLog::tick(std::int64_t now_ns) {
  if (held_back_ == 0 || now_ns - *said_ns_ < kPeriodNs) return;
  said_ns_ = now_ns;
  log(level_, std::string(what_) + ": " + std::to_string(held_back_) + " more, the last " + last_);
  held_back_ = 0;
}

}  // namespace cornerd::daemon
