// SPDX-License-Identifier: MIT
#include "message/odometry_lines.hpp"

namespace cornerd::message {
namespace {

/// A judgement takes the lines of so long: STATUS may come twice within a moment.
constexpr core::TimeNs kShortestLook_ns = core::kNsPerSecond * 9 / 10;

}  // namespace

void OdometryLines::add(const core::OdometryReading& reading) {
  ++seen_.lines;
  seen_.rates += reading.gyro_rad_s ? 1 : 0;
  if (reading.left && reading.right) {
    ++seen_.whole;
  } else if (reading.left) {
    ++seen_.left;
  } else if (reading.right) {
    ++seen_.right;
  } else if (reading.gyro_rad_s) {
    ++seen_.gyro;
  }
}

std::string_view OdometryLines::hint(const core::OdometrySummary& summary, core::TimeNs t_ns) {
  if (!judged_ns_ || t_ns < *judged_ns_) judged_ns_ = t_ns;
  if (t_ns - *judged_ns_ >= kShortestLook_ns) {
    hint_ = judge(summary.counters);
    refused_ = judge_refusals(summary.counters);
    judged_ns_ = t_ns;
    counters_ = summary.counters;
    seen_ = {};
  }
  return summary.present ? std::string_view() : hint_;
}

std::string_view OdometryLines::judge(const core::OdometryCounters& counters) const {
  if (seen_.lines == 0) return "no ODOMETRY line comes";
  if (seen_.whole == 0) {
    if (seen_.left > 0 && seen_.right > 0) {
      return "lines have left or right: both belong into one line";
    }
    if (seen_.left > 0) return "lines lack right: both wheels' counts belong into one line";
    if (seen_.right > 0) return "lines lack left: both wheels' counts belong into one line";
    if (seen_.gyro > 0) return "lines lack left and right: a gyro alone does not tell of the way";
    return "lines lack left, right and gyro";
  }
  const std::uint64_t half = seen_.lines / 2;
  if (counters.future - counters_.future > half) {
    return "t of the lines is ahead of the lidar's: it is UNIX time in seconds, or left out";
  }
  if (counters.past - counters_.past > half) {
    return "t of the lines is behind the lidar's: it is UNIX time in seconds, or left out";
  }
  if (counters.jumps - counters_.jumps > half) {
    return "counts leap by more than advanced.odometry.max_speed lets a wheel turn";
  }
  return {};
}

OdometryLines::Refused OdometryLines::judge_refusals(const core::OdometryCounters& counters) const {
  // As differences: a pipeline that takes another's place counts anew.
  const auto since = [&](auto member) {
    return counters.*member < counters_.*member ? 0 : counters.*member - counters_.*member;
  };
  const std::uint64_t untimely =
      since(&core::OdometryCounters::past) + since(&core::OdometryCounters::future);
  const auto most = [](std::uint64_t refused, std::uint64_t lines) {
    return lines > 0 && refused > lines / 2;
  };
  const bool all = most(untimely, seen_.lines);
  return {.counts = all || most(since(&core::OdometryCounters::jumps), seen_.whole),
          .gyro = all || most(since(&core::OdometryCounters::gyro), seen_.rates)};
}

}  // namespace cornerd::message
