// SPDX-License-Identifier: MIT
#include "settable_clock.hpp"

#include <cerrno>
#include <chrono>
#include <cmath>
#include <fstream>
#include <system_error>

namespace cornerd::system_test {

SettableClock::SettableClock(const std::filesystem::path& file) : file_(file) {
  std::ofstream(file_) << std::string(sizeof(ClockOffset), '\0');
  offset_ns_ = map_clock_offset(file_.c_str());
  if (offset_ns_ == nullptr) throw std::system_error(errno, std::generic_category(), file_);
}

SettableClock::~SettableClock() { ::munmap(offset_ns_, sizeof(ClockOffset)); }

std::map<std::string, std::string> SettableClock::environment() const {
  return {{"LD_PRELOAD", CORNERD_CLOCK_PRELOAD}, {kClockFileVariable, file_.string()}};
}

void SettableClock::step_s(double by_s) { *offset_ns_ += std::llround(by_s * 1e9); }

double SettableClock::offset_s() const { return static_cast<double>(*offset_ns_) * 1e-9; }

double SettableClock::now_s() const {
  const auto machine = std::chrono::system_clock::now().time_since_epoch();
  return std::chrono::duration<double>(machine).count() + offset_s();
}

}  // namespace cornerd::system_test
