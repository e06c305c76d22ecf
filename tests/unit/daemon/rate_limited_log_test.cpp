// SPDX-License-Identifier: MIT
#include "daemon/rate_limited_log.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "captured_log.hpp"
#include "core/types.hpp"

namespace cornerd::daemon {
namespace {

constexpr std::int64_t at(double seconds) {
  return static_cast<std::int64_t>(seconds * core::kNsPerSecond);
}

TEST(RateLimitedLog, ManyEventsInTenSeconds_OneLineAndSummary) {
  const CapturedLog captured;
  RateLimitedLog log(LogLevel::kWarning, "jump");
  log.add("a", at(100));
  log.add("b", at(100.1));
  log.add("c", at(109.9));
  log.flush(at(109.9));
  EXPECT_EQ(captured.text(), "warning: jump: a\n");
  log.flush(at(110));
  log.flush(at(130));
  EXPECT_EQ(captured.text(), "warning: jump: a\nwarning: jump: 2 more, the last c\n");
}

TEST(RateLimitedLog, SummaryLogged_PeriodRestarts) {
  const CapturedLog captured;
  RateLimitedLog log(LogLevel::kInfo, "jump");
  for (int i = 0; i < 1000; ++i) log.add(std::to_string(i), at(0.1 * i));
  const std::string text = captured.text();
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 10) << text;
}

TEST(RateLimitedLog, EventAfterTenSeconds_LoggedAtOnce) {
  const CapturedLog captured;
  RateLimitedLog log(LogLevel::kInfo, "jump");
  log.add("a", at(1));
  log.add("b", at(11));
  EXPECT_EQ(captured.text(), "info: jump: a\ninfo: jump: b\n");
}

}  // namespace
}  // namespace cornerd::daemon
