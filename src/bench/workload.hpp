// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "bench/methods.hpp"
#include "core/breakpoint/detector.hpp"

namespace cornerd::bench {

/// Corner detection alone, for timing and counting. The scans are sorted and converted to Cartesian
/// coordinates beforehand, which costs every method the same.
class Workload {
 public:
  Workload(const NamedMethod& method, std::span<const core::Scan> scans);

  std::size_t scans() const { return points_.size(); }

  /// Detects in one scan.
  void run(std::size_t scan);
  void run_all();

  const core::Detection& detection() const { return detection_; }

 private:
  core::Detector detector_;
  std::vector<core::PolarScan> points_;
  core::Detection detection_;
};

/// Thread CPU time of each scan in microseconds, the median of `repeats` rounds.
std::vector<double> time_scans_us(Workload& workload, std::size_t repeats);

/// Thread CPU time of sorting and converting a scan, in microseconds, the mean over the scans.
double time_preparation_us(std::span<const core::Scan> scans, std::size_t repeats);

}  // namespace cornerd::bench
