// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>

#include "core/types.hpp"
#include "replay/simulator/rotating_head.hpp"
#include "replay/simulator/scene.hpp"
#include "replay/simulator/sensor_model.hpp"
#include "replay/simulator/simulator.hpp"

namespace cornerd::replay {

/// A laser beside the axis: at distance d (mm) a wall lies atan(offset / d - offset / crossing)
/// before, as YDLIDAR's manuals have it. Nothing where the host corrects nothing.
struct Triangulation {
  double offset_mm = 0;
  double crossing_mm = 0;  ///< where beam and axis of the receiver cross

  /// From the head's angle to the wall, clockwise, degrees.
  double correction_deg(double range_m) const;
};

/// Head and ranges of a lidar whose packets hold the head's angle at both ends and ranges between.
/// Angles are clockwise from above, in degrees, not reduced.
class PacketSimulator {
 public:
  /// Throws std::invalid_argument if the motor's rate is not in [1, 15] Hz.
  PacketSimulator(std::unique_ptr<Scene> scene, const SimulatorConfig& config,
                  core::TimeNs sample_period_ns, std::optional<Triangulation> optics = {});

  /// Continues at `t_ns`, after a pause of the stream.
  void resume(core::TimeNs t_ns) { resume(t_ns, head_.period_ns()); }
  void resume(core::TimeNs t_ns, core::TimeNs period_ns) { head_.resume(t_ns, period_ns); }
  RotatingHead::Position next_head() { return head_.next(); }
  /// Of the sample after it.
  const RotatingHead::Position& head() const { return head_.position(); }
  core::TimeNs period_ns() const { return head_.period_ns(); }

  Scene& scene() { return *scene_; }

  /// What the lidar measures at this time and head angle, metres; 0: no return.
  double measure_m(core::TimeNs t_ns, double head_deg);

 private:
  double range_m(core::TimeNs t_ns, std::int64_t scan, double device_deg);
  double direction_deg(core::TimeNs t_ns, std::int64_t scan, double head_deg);
  double bearing_rad(double device_deg) const;

  std::unique_ptr<Scene> scene_;
  SimulatorConfig config_;
  std::optional<Triangulation> optics_;
  SensorErrors errors_;
  RotatingHead head_;
};

}  // namespace cornerd::replay
