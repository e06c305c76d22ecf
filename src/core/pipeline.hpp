// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <optional>
#include <utility>

#include "core/localizer.hpp"
#include "core/scan.hpp"

namespace cornerd::core {

/// From samples to poses: the one object that the daemon, replays and tests alike run. Allocates
/// nothing after construction. Not safe for concurrent calls.
class Pipeline {
 public:
  /// `map`: may be null; see Localizer.
  Pipeline(std::shared_ptr<const WallMap> map, const LocalizerConfig& config)
      : localizer_(std::move(map), config) {}

  /// What a turn gave, where this sample is the first after it; else null. Valid, like turn(),
  /// until the next call.
  const ScanResult* add(const Sample& sample) {
    now_ns_ = sample.t_ns;
    const ScanResult* result = assembler_.add(sample, scan_) ? &localizer_.step(scan_) : nullptr;
    part_ = localizer_.follow(sample);
    return result;
  }

  /// What the last sample gave where it ended a part of a turn: see Localizer::follow().
  const PoseEstimate* part() const { return part_; }

  /// What the robot's wheels and gyro say, in the order of time among the samples. Returns what
  /// Localizer::add() does. `now_ns`: by a clock, where the samples have one; else the newest
  /// sample tells the time.
  const PoseEstimate* add(const OdometryReading& reading, std::optional<TimeNs> now_ns = {}) {
    return localizer_.add(reading, now_ns ? now_ns : now_ns_);
  }

  /// The stream ends, or goes on somewhere else: what the turn in progress gave, where it is whole.
  const ScanResult* finish() {
    const bool whole = assembler_.finish(scan_);
    assembler_.reset();
    return whole ? &localizer_.step(scan_) : nullptr;
  }

  /// The turn that the last result is of.
  const Scan& scan() const { return scan_; }

  Localizer& localizer() { return localizer_; }
  const ScanAssembler& assembler() const { return assembler_; }

 private:
  std::optional<TimeNs> now_ns_;  ///< of the newest sample
  ScanAssembler assembler_;
  Scan scan_;
  Localizer localizer_;
  const PoseEstimate* part_ = nullptr;
};

}  // namespace cornerd::core
