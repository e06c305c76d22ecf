// SPDX-License-Identifier: MIT
#include "drivers/rplidar/live_sink.hpp"

namespace cornerd::rplidar {
namespace {

constexpr int kBlindTurns = 20;
constexpr std::size_t kMinReturnsPercent = 1;

}  // namespace

void LiveSink::on_sample(const core::Sample& sample) {
  if (sample.starts_turn) end_turn();
  ++turn_samples_;
  if (sample.range_m > 0) ++turn_returns_;
  board_.count(sample);
  next_.on_sample(sample);
}

bool LiveSink::blind() const { return blind_turns_ >= kBlindTurns; }

void LiveSink::end_turn() {
  const bool sees = turn_returns_ * 100 >= turn_samples_ * kMinReturnsPercent;
  blind_turns_ = sees ? 0 : blind_turns_ + 1;
  turn_samples_ = 0;
  turn_returns_ = 0;
}

}  // namespace cornerd::rplidar
