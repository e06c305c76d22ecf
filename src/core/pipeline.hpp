// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <optional>
#include <span>

#include "core/map_choice.hpp"
#include "core/scan.hpp"

namespace cornerd::core {

/// From samples to poses; used by the daemon, replays and tests. Allocates nothing after
/// construction. Not safe for concurrent calls.
class Pipeline {
 public:
  /// `map`: may be null; see Localizer.
  Pipeline(std::shared_ptr<const WallMap> map, const LocalizerConfig& config)
      : Pipeline(std::span(&map, 1), config) {}
  /// Several maps: see MapChoice.
  Pipeline(std::span<const std::shared_ptr<const WallMap>> maps, const LocalizerConfig& config)
      : maps_(maps, config) {}

  /// The result of a scan, if this sample is the first after it; else null. Valid, as scan(), until
  /// the next call.
  const ScanResult* add(const Sample& sample) {
    newest_ns_ = sample.t_ns;
    const ScanResult* result = assembler_.add(sample, scan_) ? &maps_.step(scan_) : nullptr;
    partial_pose_ = localizer().follow(sample);
    return result;
  }

  /// Pose from a partial scan, if the last sample ended one; see Localizer::follow().
  const PoseEstimate* partial_pose() const { return partial_pose_; }

  /// Odometry, in order of time among the samples. Returns as Localizer::add(). A reading without
  /// an arrival time came after the newest sample.
  const PoseEstimate* add(const OdometryReading& reading) {
    return localizer().add(reading.arrival_ns ? reading : reading.arrived(newest_ns_));
  }

  /// End of the stream: the result of the scan in progress, if it is complete.
  const ScanResult* finish() {
    const bool whole = assembler_.finish(scan_);
    assembler_.reset();
    return whole ? &maps_.step(scan_) : nullptr;
  }

  /// The scan of the last result.
  const Scan& scan() const { return scan_; }

  /// Of the map; where it is not known yet, one without a map.
  Localizer& localizer() { return maps_.localizer(); }
  MapChoice& maps() { return maps_; }
  const ScanAssembler& assembler() const { return assembler_; }

 private:
  std::optional<TimeNs> newest_ns_;  ///< sample
  ScanAssembler assembler_;
  Scan scan_;
  MapChoice maps_;
  const PoseEstimate* partial_pose_ = nullptr;
};

}  // namespace cornerd::core
