// SPDX-License-Identifier: MIT
#include "tool/doctor/daemon_probe.hpp"

#include <numeric>
#include <optional>
#include <string_view>

#include "client/connection.hpp"
#include "client/subscription.hpp"

namespace cornerd::tool {

namespace {

/// 1.5 s at an A1's scan rate.
constexpr std::uint64_t kMinPoses = 10;

/// STATUS comes every second; a change of state sends one more at once.
constexpr double kMinSpan_s = 0.8;

/// The rate of odometry readings, from the first STATUS to the last.
class ReadingRate {
 public:
  void note(const message::ParsedStatus& status) {
    if (!status.odometry_readings) return;
    const Count count{status.t_ns, *status.odometry_readings};
    if (!first_ || count.readings < first_->readings) first_ = count;  // the daemon restarted
    last_ = count;
  }
  /// False while the daemon counts readings and the span is too short for a rate.
  bool is_settled() const { return !first_ || hz(); }
  std::optional<double> hz() const {
    if (!first_) return std::nullopt;
    const double span_s = core::to_seconds(last_.t_ns - first_->t_ns);
    if (span_s < kMinSpan_s) return std::nullopt;
    return (last_.readings - first_->readings) / span_s;
  }

 private:
  struct Count {
    core::TimeNs t_ns = 0;
    double readings = 0;
  };
  std::optional<Count> first_;
  Count last_;
};

void take_line(std::string_view line, DaemonView& view, ReadingRate& rate) {
  message::ParsedLine parsed = message::parse_line(line);
  if (const auto* version = std::get_if<message::ParsedVersion>(&parsed)) {
    view.version = version->version;
  } else if (auto* status = std::get_if<message::ParsedStatus>(&parsed)) {
    rate.note(*status);
    view.status = std::move(*status);
  } else if (const auto* pose = std::get_if<message::ParsedPose>(&parsed)) {
    ++view.poses[static_cast<std::size_t>(pose->state)];
    const bool is_of_scan =
        pose->state == core::PoseState::kFix || pose->state == core::PoseState::kTracking;
    if (is_of_scan && pose->rmse_m) view.rmse_m.push_back(*pose->rmse_m);
  } else if (const auto* scan = std::get_if<message::RecordedScan>(&parsed)) {
    for (const core::Sample& sample : scan->samples) {
      if (sample.range_m > 0) view.scan_returns_m.push_back(sample.range_m);
    }
  }
}

bool has_enough(const DaemonView& view) {
  return view.status &&
         std::accumulate(view.poses.begin(), view.poses.end(), std::uint64_t{0}) >= kMinPoses;
}

}  // namespace

DaemonView probe_daemon(const std::filesystem::path& socket, std::chrono::milliseconds at_most) {
  using Clock = std::chrono::steady_clock;
  DaemonView view;
  client::Connection daemon;
  if (!daemon.connect(socket, /*blocking=*/false)) {
    view.connect_errno = daemon.error_number();
    return view;
  }
  daemon.send(client::watch_request("POSE,STATUS,SCAN"));
  ReadingRate rate;
  const Clock::time_point end = Clock::now() + at_most;
  while (!has_enough(view) || !rate.is_settled()) {
    const auto left = std::chrono::ceil<std::chrono::milliseconds>(end - Clock::now());
    if (left.count() <= 0) break;
    std::string_view line;
    client::Received received = daemon.receive(line, left);
    // What has come together is judged together.
    for (; received == client::Received::kLine; received = daemon.take(line)) {
      take_line(line, view, rate);
    }
    if (received == client::Received::kEnd) break;
  }
  view.odometry_hz = rate.hz();
  return view;
}

}  // namespace cornerd::tool
