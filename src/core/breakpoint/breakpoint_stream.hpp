// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "core/breakpoint/altbd.hpp"
#include "core/breakpoint/breakpoint.hpp"
#include "core/breakpoint/wall_chain.hpp"
#include "core/detector_config.hpp"
#include "core/polar_scan.hpp"
#include "core/sensor_noise.hpp"

namespace cornerd::core {

/// Which way the head turns, seen from above. An A1 on its feet turns clockwise.
enum class Sweep : std::int8_t { kCounterClockwise = +1, kClockwise = -1 };

/// ALTBD while the turn goes on: fed return by return, it says what each breakpoint is as soon as
/// nothing that follows can change it: when the wall after it has shown itself and the wall before
/// it has ended. Those at the seam, where the turn began, come at its end.
///
/// The breakpoints are exactly those that a Detector finds in the whole turn, if that begins at the
/// same bearing and is taken in the same sense (breakpoint_stream_test.cpp). All memory is taken at
/// construction.
class BreakpointStream {
 public:
  BreakpointStream(const DetectorConfig& config, const SensorNoise& noise);

  /// A turn begins. `spacing_rad`: distance in bearing between two samples, as of the turn
  /// before.
  void begin(double spacing_rad, Sweep sweep);

  /// The next return, lidar frame. A bearing may step back by up to kMaxStepBack_rad, as those of
  /// an A1 do. Ranges that are none, returns beyond a whole circle, and more than
  /// kMaxSamplesPerScan are ignored. The breakpoints that this return made certain; valid until the
  /// next call.
  std::span<const Breakpoint> add(double bearing_rad, double range_m);

  /// The turn is at its end: the rest of its breakpoints.
  std::span<const Breakpoint> finish();

  /// All breakpoints so far, and at the end of the turn its walls. Taken in the sweep's sense: a
  /// clockwise turn is seen in a mirror here.
  const Detection& detection() const { return detection_; }

  /// 2.5 degrees: an A1 corrects bearings by the range, which differs at an edge.
  static constexpr double kMaxStepBack_rad = radians(2.5);

 private:
  struct Return {
    double sweep_rad = 0;  ///< how far the head has turned
    double range_m = 0;
  };
  void take(const Return& item);
  std::span<const Breakpoint> news(std::size_t known);

  Altbd tracker_;
  WallChain chain_;
  Sweep sweep_ = Sweep::kClockwise;
  PolarScan scan_;
  Detection detection_;
  std::vector<Breakpoint> mirrored_;
  std::array<Return, 96> waiting_;  ///< by rising sweep: what a later return may still precede
  std::size_t waiting_count_ = 0;
  double reached_rad_ = 0;
  double begin_rad_ = 0;
  bool begun_ = false;
  bool finished_ = true;
};

/// The same breakpoint in a mirror along the x axis: what was on its left is on its right.
Breakpoint mirrored(const Breakpoint& breakpoint);

}  // namespace cornerd::core
