// SPDX-License-Identifier: MIT
#include "core/odometry/motion_path.hpp"

#include <algorithm>

#include "core/odometry/motion_step.hpp"

namespace cornerd::core {

void MotionPath::put(const Point& point) {
  points_[next_] = point;
  next_ = (next_ + 1) % kCapacity;
  size_ = std::min(size_ + 1, kCapacity);
}

void MotionPath::add(TimeNs from_ns, TimeNs t_ns, const Pose2& motion) {
  if (size_ > 0 && point(0).t_ns != from_ns) clear();
  if (size_ == 0) put({from_ns, {}});
  put({t_ns, point(0).T_start_base * motion});
}

bool MotionPath::covers(TimeNs from_ns, TimeNs to_ns) const {
  return size_ > 1 && from_ns >= point(size_ - 1).t_ns && to_ns <= point(0).t_ns + kLongestGuess_ns;
}

Pose2 MotionPath::at(TimeNs t_ns) const {
  std::size_t age = 1;  // of the older end of the piece that holds t_ns
  while (age + 1 < size_ && point(age).t_ns > t_ns) ++age;
  const Point& from = point(age);
  const Point& to = point(age - 1);
  const double share =
      static_cast<double>(t_ns - from.t_ns) / static_cast<double>(to.t_ns - from.t_ns);
  const Pose2 way = from.T_start_base.inverse() * to.T_start_base;
  // The same arc, begun or carried on: half-way through its turn it points along its chord.
  const double half_rad = way.theta_rad / 2;
  const double chord_m = way.x_m * std::cos(half_rad) + way.y_m * std::sin(half_rad);
  return from.T_start_base * arc(share * chord_m, share * way.theta_rad);
}

}  // namespace cornerd::core
