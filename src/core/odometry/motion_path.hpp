// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <optional>

#include "core/geometry/pose2.hpp"
#include "core/types.hpp"

namespace cornerd::core {

/// Where `base` was lately, in a frame of its own that starts anywhere and drifts: what the samples
/// of a scan are moved back by. Holds the last readings alone; nothing is allocated.
class MotionPath {
 public:
  /// Goes on by a motion that ends at `t_ns`.
  void add(TimeNs from_ns, TimeNs t_ns, const Pose2& motion);
  /// What was before is of no use: the motion from there is not known.
  void clear() { size_ = 0; }

  /// True where the path tells of all of this time, but for what the last motion may be carried on.
  bool covers(TimeNs from_ns, TimeNs to_ns) const;

  /// Where it ends; 0 where there is none.
  TimeNs newest_ns() const { return size_ > 0 ? point(0).t_ns : 0; }

  /// The pose at a time that is covered. Times that grow are found fastest.
  Pose2 at(TimeNs t_ns) const;

  /// How fast `base` moved, from a little before that time to as much after it, so that a change of
  /// speed is not seen late; none where too little is known.
  Twist2 velocity_at(TimeNs t_ns) const;

  /// Mean squares along x and of the heading.
  struct Change {
    double x_m2 = 0;
    double theta_rad2 = 0;
  };
  /// How unevenly it was driven: the mean square, over the time, of the change of speed from one
  /// pair of readings to the next, times the interval between readings.
  Change mean_square_change(TimeNs from_ns, TimeNs to_ns) const;

  /// The last motion is taken to go on for so long after the last reading.
  static constexpr TimeNs kLongestGuess_ns = kNsPerSecond / 4;

 private:
  /// Two seconds at 200 readings a second.
  static constexpr std::size_t kCapacity = 512;
  struct Point {
    TimeNs t_ns = 0;
    Pose2 T_start_base;
  };
  const Point& point(std::size_t age) const {
    return points_[(next_ + 2 * kCapacity - 1 - age) % kCapacity];
  }
  void put(const Point& point);

  std::array<Point, kCapacity> points_;
  std::size_t next_ = 0;
  std::size_t size_ = 0;
};

}  // namespace cornerd::core
