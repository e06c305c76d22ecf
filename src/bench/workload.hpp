// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "bench/methods.hpp"
#include "core/breakpoint/detector.hpp"

namespace cornerd::bench {

/// Turns to detect corners in, and nothing else: what is timed and counted. A turn is what the
/// paper's clock starts at, angles and ranges, put in order and into Cartesian coordinates, which
/// is the same for every method.
class Workload {
 public:
  Workload(const NamedMethod& method, std::span<const core::Scan> scans);

  std::size_t scans() const { return points_.size(); }

  /// Detects in one turn.
  void run(std::size_t scan);
  void run_all();

  const core::Detection& detection() const { return detection_; }

 private:
  core::Detector detector_;
  std::vector<core::PolarScan> points_;
  core::Detection detection_;
};

/// CPU time of this thread that each turn takes, the median of `repeats` rounds, in microseconds.
std::vector<double> time_scans_us(Workload& workload, std::size_t repeats);

/// CPU time of this thread that putting a turn in order takes, in microseconds: the mean over the
/// turns.
double time_preparation_us(std::span<const core::Scan> scans, std::size_t repeats);

}  // namespace cornerd::bench
