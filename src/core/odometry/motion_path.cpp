// SPDX-License-Identifier: MIT
#include "core/odometry/motion_path.hpp"

#include <algorithm>
#include <cmath>

#include "core/geometry/squared.hpp"
#include "core/odometry/odometry_increment.hpp"

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

MotionPath::Change MotionPath::mean_square_change(TimeNs from_ns, TimeNs to_ns) const {
  Change sum;
  double all_s = 0;
  for (std::size_t age = 1; age + 1 < size_ && point(age - 1).t_ns > from_ns; ++age) {
    if (point(age + 1).t_ns >= to_ns) continue;
    const double before_s = to_seconds(point(age).t_ns - point(age + 1).t_ns);
    const double after_s = to_seconds(point(age - 1).t_ns - point(age).t_ns);
    const Pose2 before = point(age + 1).T_start_base.inverse() * point(age).T_start_base;
    const Pose2 after = point(age).T_start_base.inverse() * point(age - 1).T_start_base;
    const double longer_s = std::max(before_s, after_s);
    const auto change2 = [&](double motion, double motion_after) {
      return squared(longer_s * (motion_after / after_s - motion / before_s));
    };
    sum.x_m2 += longer_s * change2(before.x_m, after.x_m);
    sum.theta_rad2 += longer_s * change2(before.theta_rad, after.theta_rad);
    all_s += longer_s;
  }
  return all_s > 0 ? Change{sum.x_m2 / all_s, sum.theta_rad2 / all_s} : Change{};
}

Twist2 MotionPath::velocity_at(TimeNs t_ns) const {
  constexpr double kAround_s = 0.06;
  const TimeNs half_ns = from_seconds(kAround_s / 2);
  if (!covers(t_ns - half_ns, t_ns + half_ns)) return {};
  const Pose2 motion = at(t_ns - half_ns).inverse() * at(t_ns + half_ns);
  return {motion.x_m / kAround_s, motion.y_m / kAround_s, motion.theta_rad / kAround_s};
}

Pose2 MotionPath::at(TimeNs t_ns) const {
  std::size_t age = 1;  // of the older end of the piece that holds t_ns
  while (age + 1 < size_ && point(age).t_ns > t_ns) ++age;
  const Point& from = point(age);
  const Point& to = point(age - 1);
  const double share =
      static_cast<double>(t_ns - from.t_ns) / static_cast<double>(to.t_ns - from.t_ns);
  const Pose2 motion = from.T_start_base.inverse() * to.T_start_base;
  // The same arc, begun or carried on: half-way through its turn it points along its chord.
  const double half_rad = motion.theta_rad / 2;
  const double chord_m = motion.x_m * std::cos(half_rad) + motion.y_m * std::sin(half_rad);
  return from.T_start_base * arc(share * chord_m, share * motion.theta_rad);
}

}  // namespace cornerd::core
