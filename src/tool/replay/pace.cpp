// SPDX-License-Identifier: MIT
#include "tool/replay/pace.hpp"

#include <charconv>
#include <cmath>
#include <thread>

#include "tool/command_line/failure.hpp"

namespace cornerd::tool {

std::optional<double> parse_speed(const std::string& text) {
  if (text == "max") return std::nullopt;
  double speed = 0;
  const char* const end = text.data() + text.size();
  const auto [parsed_to, error] = std::from_chars(text.data(), end, speed);
  if (error != std::errc() || parsed_to != end || !std::isfinite(speed) || speed <= 0) {
    throw UsageError("--speed: '" + text + "' is neither max nor a number above 0");
  }
  return speed;
}

void Pace::wait_until(core::TimeNs data_ns) {
  if (!first_data_ns_) {
    first_data_ns_ = data_ns;
    began_ = Clock::now();
  }
  const std::chrono::duration<double, std::nano> wait(
      static_cast<double>(data_ns - *first_data_ns_) / speed_);
  std::this_thread::sleep_until(began_ + std::chrono::duration_cast<Clock::duration>(wait));
}

}  // namespace cornerd::tool
