// SPDX-License-Identifier: MIT
#include "message/odometry_input_monitor.hpp"

#include <algorithm>

#include "core/odometry/motion_path.hpp"

namespace cornerd::message {
namespace {

/// Length of an evaluated interval; replays call once a second of the recording, more or less.
constexpr core::TimeNs kMinInterval_ns = core::kNsPerSecond * 9 / 10;

/// Readings that end longer before a scan's middle do not tell the motion of the scan.
constexpr core::TimeNs kMaxAge_ns = core::MotionPath::kLongestGuess_ns;

/// Readings that are further apart leave scans without one (kMaxAge_ns).
constexpr std::uint64_t kMinRate_hz = 5;

/// Lines that came less long ago: their program has not ended.
constexpr core::TimeNs kLately_ns = 5 * core::kNsPerSecond;

std::string seconds_text(core::TimeNs duration_ns) {
  const core::TimeNs tenths = (duration_ns + core::kNsPerSecond / 20) / (core::kNsPerSecond / 10);
  return std::to_string(tenths / 10) + "." + std::to_string(tenths % 10) + " s";
}

}  // namespace

void OdometryInputMonitor::add(const core::OdometryReading& reading) {
  ++lines_.all;
  lines_.repeated += reading.t_ns == newest_ns_ ? 1 : 0;
  newest_ns_ = reading.t_ns;
  lines_.rates += reading.gyro_rad_s ? 1 : 0;
  if (reading.left && reading.right) {
    ++lines_.both;
  } else if (reading.left) {
    ++lines_.left;
  } else if (reading.right) {
    ++lines_.right;
  }
}

void OdometryInputMonitor::refuse(const RequestError& error) {
  ++lines_.refused;
  refusal_ = error.text;
  const std::string_view cause = error.cause.empty() ? std::string_view(error.code) : error.cause;
  const auto known = std::find_if(refusals_.begin(), refusals_.end(),
                                  [&](const Refusals& one) { return one.cause == cause; });
  ++(known == refusals_.end() ? refusals_.back() : *known).count;
}

void OdometryInputMonitor::update(const core::OdometryCounters& counters, core::TimeNs t_ns) {
  if (!evaluated_ns_ || t_ns < *evaluated_ns_) evaluated_ns_ = t_ns;
  if (t_ns - *evaluated_ns_ < kMinInterval_ns) return;
  are_refused_ = lines_.refused > lines_.all;
  hint_ = diagnose(counters, t_ns);
  rejected_ = find_rejected(counters);
  evaluated_ns_ = t_ns;
  counters_ = counters;
  if (lines_.all > 0) last_lines_ = {lines_.all, t_ns};
  lines_ = {};
}

std::string OdometryInputMonitor::diagnose(const core::OdometryCounters& counters,
                                           core::TimeNs t_ns) const {
  if (are_refused_) return "ODOMETRY lines are refused: " + refusal_;
  const bool came_lately = last_lines_ && t_ns - last_lines_->t_ns < kLately_ns;
  const auto too_rare = [](const std::string& rate) {
    return "ODOMETRY lines come too rarely (" + rate +
           "): send at least 10 a second, 50 are better";
  };
  if (lines_.all == 0 && came_lately && last_lines_->count < kMinRate_hz) {
    return too_rare("not one in the last second");
  }
  if (lines_.all == 0)
    return "no ODOMETRY line arrives: start the program that sends encoder counts to the control "
           "socket, each line with its newline";
  if (lines_.both == 0) {
    if (lines_.left > 0 && lines_.right > 0) {
      return "ODOMETRY lines have left or right: send both counts in one line";
    }
    if (lines_.left > 0) return "ODOMETRY lines lack right: send both counts in one line";
    if (lines_.right > 0) return "ODOMETRY lines lack left: send both counts in one line";
    return "ODOMETRY lines lack left and right: a gyro does not measure distance, send encoder "
           "counts too";
  }
  const std::uint64_t half = lines_.all / 2;
  const std::uint64_t ahead = counters.future - counters_.future;
  const std::uint64_t behind = counters.past - counters_.past;
  if (ahead + behind > half && lines_.repeated > half) {
    return "t of ODOMETRY lines repeats: send the time of each reading with its fractions of a "
           "second, or no t";
  }
  if (ahead > half) {
    return "t of ODOMETRY lines is ahead of the lidar's clock: send UNIX time in seconds, or no t";
  }
  if (behind > half) {
    return "t of ODOMETRY lines is behind the lidar's clock: send UNIX time in seconds, or no t";
  }
  if (counters.jumps - counters_.jumps > half) {
    return "counts of ODOMETRY lines jump by more than /advanced/odometry/max_speed allows: check "
           "the encoders, counts_per_turn and wheel_radius";
  }
  // The lines may have begun at the end of the interval.
  if (!came_lately) return {};
  if (lines_.all < kMinRate_hz) return too_rare(std::to_string(lines_.all) + " in the last second");
  if (t_ns - newest_ns_ > kMaxAge_ns) {
    return "t of ODOMETRY lines is " + seconds_text(t_ns - newest_ns_) +
           " behind the lidar's clock: send the UNIX time of the reading in seconds, without "
           "delay, or no t";
  }
  return {};
}

OdometryInputMonitor::Rejected OdometryInputMonitor::find_rejected(
    const core::OdometryCounters& counters) const {
  // A new pipeline, after a reload, counts from 0.
  const auto since = [&](auto member) {
    return counters.*member < counters_.*member ? 0 : counters.*member - counters_.*member;
  };
  const std::uint64_t wrong_time =
      since(&core::OdometryCounters::past) + since(&core::OdometryCounters::future);
  const auto is_most = [](std::uint64_t rejected, std::uint64_t lines) {
    return lines > 0 && rejected > lines / 2;
  };
  const bool all = is_most(wrong_time, lines_.all);
  return {.counts = all || is_most(since(&core::OdometryCounters::jumps), lines_.both),
          .gyro = all || is_most(since(&core::OdometryCounters::invalid_rates), lines_.rates)};
}

}  // namespace cornerd::message
