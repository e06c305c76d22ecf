// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "core/breakpoint/altbd.hpp"
#include "core/breakpoint/breakpoint.hpp"
#include "core/breakpoint/wall_polyline.hpp"
#include "core/detector_config.hpp"
#include "core/polar_scan.hpp"
#include "core/sensor_noise.hpp"

namespace cornerd::core {

/// Rotation of the head seen from above. An upright A1 rotates clockwise.
enum class Sweep : std::int8_t { kCounterClockwise = +1, kClockwise = -1 };

/// ALTBD on a scan in progress: reports each breakpoint as soon as no later return can change it,
/// which is when the wall after it has begun and the wall before it is complete. Breakpoints at the
/// seam, where the scan began, come at its end.
///
/// The result equals that of a Detector on the complete scan, if that begins at the same bearing
/// and is taken in the same sense (breakpoint_stream_test.cpp). Allocates nothing after
/// construction.
class BreakpointStream {
 public:
  BreakpointStream(const DetectorConfig& config, const SensorNoise& noise);

  /// Starts a scan. `spacing_rad`: distance in bearing between two samples, from the previous scan.
  void begin(double spacing_rad, Sweep sweep);

  /// Adds a return, lidar frame. Bearings may step back by up to kMaxStepBack_rad. Invalid ranges,
  /// returns beyond 2 pi and more than kMaxSamplesPerScan are ignored. Returns the breakpoints that
  /// became final; valid until the next call.
  std::span<const Breakpoint> add(double bearing_rad, double range_m);

  /// Ends the scan: returns the remaining breakpoints.
  std::span<const Breakpoint> finish();

  /// All breakpoints so far and, after finish(), the walls. In the sense of the sweep: a clockwise
  /// scan is mirrored here.
  const Detection& detection() const { return detection_; }

  /// An A1 corrects bearings by the range, which steps at an edge.
  static constexpr double kMaxStepBack_rad = radians(2.5);

 private:
  struct Return {
    double sweep_rad = 0;  ///< rotation of the head
    double range_m = 0;
  };
  void take(const Return& item);
  std::span<const Breakpoint> new_breakpoints(std::size_t known_count);

  Altbd tracker_;
  WallPolyline polyline_;
  Sweep sweep_ = Sweep::kClockwise;
  PolarScan scan_;
  Detection detection_;
  std::vector<Breakpoint> mirrored_;
  std::array<Return, 96> reorder_buffer_;  ///< returns that a later one may precede, sorted
  std::size_t buffered_ = 0;
  double max_sweep_rad_ = 0;
  double begin_rad_ = 0;
  bool started_ = false;
  bool finished_ = true;
};

/// The breakpoint mirrored at the x axis: left and right are exchanged.
Breakpoint mirrored(const Breakpoint& breakpoint);

}  // namespace cornerd::core
