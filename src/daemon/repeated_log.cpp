// SPDX-License-Identifier: MIT
#include "daemon/repeated_log.hpp"

#include <spdlog/spdlog.h>

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
  spdlog::log(level_, "{}: {}", what_, text);
}

void RepeatedLog::tick(std::int64_t now_ns) {
  if (held_back_ == 0 || now_ns - *said_ns_ < kPeriodNs) return;
  said_ns_ = now_ns;
  spdlog::log(level_, "{}: {} more, the last {}", what_, held_back_, last_);
  held_back_ = 0;
}

}  // namespace cornerd::daemon
