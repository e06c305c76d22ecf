// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <utility>
#include <vector>

#include "core/odometry/odometry_reading.hpp"
#include "replay/recording.hpp"

namespace cornerd::tool {

/// Gives a sink a recording with the odometry of another file in place of its own: each reading
/// before the first sample that is later, but for one of another clock, which must not hold up the
/// others. `sink` must outlive this.
class OtherOdometry final : public replay::RecordingSink {
 public:
  OtherOdometry(replay::RecordingSink& sink, std::vector<core::OdometryReading> readings)
      : sink_(sink), readings_(std::move(readings)) {}

  void on_sample(const core::Sample& sample) override {
    for (; next_ < readings_.size(); ++next_) {
      const core::TimeNs ahead_ns = readings_[next_].t_ns - sample.t_ns;
      if (ahead_ns > 0 && ahead_ns < kMaxAhead_ns) break;
      sink_.on_odometry({readings_[next_], /*timed=*/true});
    }
    sink_.on_sample(sample);
  }
  void on_gap() override { sink_.on_gap(); }
  void on_odometry(const message::OdometryReading& /*reading*/) override {}

 private:
  static constexpr core::TimeNs kMaxAhead_ns = 10 * core::kNsPerSecond;

  replay::RecordingSink& sink_;
  std::vector<core::OdometryReading> readings_;
  std::size_t next_ = 0;
};

}  // namespace cornerd::tool
