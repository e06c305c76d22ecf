// SPDX-License-Identifier: MIT
#include "replay/simulator/simulated_odometry.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

namespace cornerd::replay {
namespace {

/// Integration step; a gyro's low-pass filter is about as slow.
constexpr core::TimeNs kStepNs = 2'000'000;
constexpr core::TimeNs kSlipNs = core::kNsPerSecond / 5;

double metres_to_next(Random& random, double per_m) {
  if (!(per_m > 0)) return std::numeric_limits<double>::infinity();
  return -std::log(1 - random.uniform()) / per_m;
}

}  // namespace

SimulatedOdometry::SimulatedOdometry(Motion motion, const RobotModel& model, std::uint64_t seed)
    : motion_(std::move(motion)),
      model_(model),
      random_(seed),
      period_ns_(core::from_seconds(1 / std::max(model.rate_hz, 1e-3))),
      T_map_base_(motion_(0, 0)) {
  if (!(model.rate_hz >= 1 && model.rate_hz <= 1000)) {
    throw std::invalid_argument("robot model: rate_hz must be 1 to 1000 readings per second");
  }
  until_slip_m_ = metres_to_next(random_, model.slips_per_m);
}

core::OdometryReading SimulatedOdometry::next() {
  while (now_ns_ < next_ns_) advance(std::min(next_ns_, now_ns_ + kStepNs));
  core::OdometryReading reading;
  reading.t_ns = next_ns_;
  next_ns_ += period_ns_;
  const core::DriveGeometry& geometry = model_.geometry;
  const auto counts = [&](double distance_m) {
    const auto count =
        static_cast<std::int64_t>(std::floor(distance_m / geometry.metres_per_count()));
    if (geometry.counter_max <= 0) return count;
    const std::int64_t span = geometry.counter_max + 1;
    return (count % span + span) % span;
  };
  reading.left = counts(left_m_);
  reading.right = counts(right_m_);
  if (model_.has_gyro) {
    const double noise_rad_s =
        model_.gyro_rad_s_per_sqrt_hz * std::sqrt(model_.rate_hz) * random_.normal();
    const double rate_rad_s =
        rate_rad_s_ * (1 + model_.gyro_scale) + model_.gyro_bias_rad_s + noise_rad_s;
    const double step = model_.gyro_step_rad_s;
    reading.gyro_rad_s = step > 0 ? std::round(rate_rad_s / step) * step : rate_rad_s;
  }
  return reading;
}

void SimulatedOdometry::advance(core::TimeNs to_ns) {
  const core::Pose2 T_map_next = motion_(to_ns, 0);
  const core::Pose2 way = T_map_base_.inverse() * T_map_next;
  const double dt_s = core::to_seconds(to_ns - now_ns_);
  const double rotation_rad = way.theta_rad;
  const double distance_m =
      way.x_m * std::cos(rotation_rad / 2) + way.y_m * std::sin(rotation_rad / 2);
  const double half_m = rotation_rad * model_.geometry.track_m * (1 + model_.track_scale) / 2;
  double left_m = wheel_travel(distance_m - half_m, model_.left_scale);
  double right_m = wheel_travel(distance_m + half_m, model_.right_scale);

  until_slip_m_ -= std::abs(distance_m) + std::abs(half_m);
  if (until_slip_m_ <= 0) {
    until_slip_m_ = metres_to_next(random_, model_.slips_per_m);
    slips_until_ns_ = now_ns_ + kSlipNs;
    left_slips_ = random_.chance(0.5);
  }
  if (now_ns_ < slips_until_ns_) (left_slips_ ? left_m : right_m) *= 1 + model_.slip_share;

  left_m_ += left_m;
  right_m_ += right_m;
  rate_rad_s_ = rotation_rad / dt_s;
  T_map_base_ = T_map_next;
  now_ns_ = to_ns;
}

double SimulatedOdometry::wheel_travel(double distance_m, double radius_scale) {
  const double noise_m =
      model_.wheel_m_per_sqrt_m * std::sqrt(std::abs(distance_m)) * random_.normal();
  return (distance_m + noise_m) / (1 + radius_scale);
}

}  // namespace cornerd::replay
