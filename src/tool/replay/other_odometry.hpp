// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <utility>
#include <vector>

#include "core/odometry/odometry_reading.hpp"
#include "replay/recording.hpp"

namespace cornerd::tool {

/// Readings by their times, not by their places in a recording.
class TimedReadings {
 public:
  explicit TimedReadings(std::vector<core::OdometryReading> readings)
      : readings_(std::move(readings)) {}

  /// Calls `use` for those up to `t_ns` that it was not called for, and for any of the far future:
  /// one of another clock must not hold up the others.
  void take_until(core::TimeNs t_ns, const auto& use) {
    for (; next_ < readings_.size(); ++next_) {
      const core::TimeNs ahead_ns = readings_[next_].t_ns - t_ns;
      if (ahead_ns > 0 && ahead_ns < kFarFuture_ns) return;
      use(readings_[next_]);
    }
  }

 private:
  static constexpr core::TimeNs kFarFuture_ns = 10 * core::kNsPerSecond;

  std::vector<core::OdometryReading> readings_;
  std::size_t next_ = 0;
};

/// Gives a sink a recording with the odometry of another file in place of its own. `sink` must
/// outlive this.
class OtherOdometry final : public replay::RecordingSink {
 public:
  OtherOdometry(replay::RecordingSink& sink, std::vector<core::OdometryReading> readings)
      : sink_(sink), readings_(std::move(readings)) {}

  void on_sample(const core::Sample& sample) override {
    readings_.take_until(sample.t_ns, [&](const core::OdometryReading& reading) {
      sink_.on_odometry({reading, /*timed=*/true});
    });
    sink_.on_sample(sample);
  }
  void on_gap() override { sink_.on_gap(); }
  void on_odometry(const message::OdometryReading& /*reading*/) override {}

 private:
  replay::RecordingSink& sink_;
  TimedReadings readings_;
};

}  // namespace cornerd::tool
