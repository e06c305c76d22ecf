// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>

#include "drivers/lidar_driver.hpp"
#include "drivers/rplidar/status_board.hpp"

namespace cornerd::rplidar {

/// Between the stream and whoever wants its samples: shows them to the status, and watches
/// whether the laser sees anything at all.
class LiveSink : public drivers::SampleSink {
 public:
  LiveSink(drivers::SampleSink& next, StatusBoard& board) : next_(next), board_(board) {}

  void on_sample(const core::Sample& sample) override;
  void on_gap() override { next_.on_gap(); }

  /// Many turns in a row without a return: a device can be healthy and blind.
  bool blind() const;

 private:
  void end_scan();

  drivers::SampleSink& next_;
  StatusBoard& board_;
  std::size_t scan_samples_ = 0;
  std::size_t turn_returns_ = 0;
  int empty_scans_ = 0;
};

}  // namespace cornerd::rplidar
