// SPDX-License-Identifier: MIT
#include "drivers/rplidar/live_sink.hpp"

namespace cornerd::rplidar {
namespace {

constexpr int kEmptyScans = 20;
constexpr std::size_t kMinReturnsPercent = 1;

}  // namespace

void LiveSink::on_sample(const core::Sample& sample) {
  if (sample.starts_scan) end_scan();
  ++scan_samples_;
  if (sample.range_m > 0) ++turn_returns_;
  board_.count(sample);
  next_.on_sample(sample);
}

bool LiveSink::blind() const { return empty_scans_ >= kEmptyScans; }

void LiveSink::end_scan() {
  const bool sees = turn_returns_ * 100 >= scan_samples_ * kMinReturnsPercent;
  empty_scans_ = sees ? 0 : empty_scans_ + 1;
  scan_samples_ = 0;
  turn_returns_ = 0;
}

}  // namespace cornerd::rplidar
