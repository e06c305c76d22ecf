// SPDX-License-Identifier: MIT
#include "daemon/rate_limited_log.hpp"

#include "core/types.hpp"

namespace cornerd::daemon {
namespace {

constexpr std::int64_t kPeriodNs = 10 * core::kNsPerSecond;

}  // namespace

void RateLimitedLog::add(const std::string& text, std::int64_t now_ns) {
  flush(now_ns);
  if (logged_ns_ && now_ns - *logged_ns_ < kPeriodNs) {
    ++suppressed_;
    last_ = text;
    return;
  }
  logged_ns_ = now_ns;
  log(level_, std::string(what_) + ": " + text);
}

void RateLimitedLog::flush(std::int64_t now_ns) {
  if (suppressed_ == 0 || now_ns - *logged_ns_ < kPeriodNs) return;
  logged_ns_ = now_ns;
  log(level_, std::string(what_) + ": " + std::to_string(suppressed_) + " more, the last " + last_);
  suppressed_ = 0;
}

}  // namespace cornerd::daemon
