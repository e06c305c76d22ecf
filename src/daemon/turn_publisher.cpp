// SPDX-License-Identifier: MIT
#include "daemon/turn_publisher.hpp"

#include <spdlog/spdlog.h>

#include <string>
#include <utility>

#include "message/state_names.hpp"

namespace cornerd::daemon {

using message::MessageClass;

TurnPublisher::TurnPublisher(MessageServer& server, std::shared_ptr<const core::WallMap> map)
    : server_(server), map_(std::move(map)) {}

void TurnPublisher::publish(const TurnReport& report) {
  const core::PoseEstimate& pose = report.result.pose;
  latencies_.add(core::to_seconds(report.latency_ns));
  ++poses_[static_cast<std::size_t>(pose.state)];
  odometry_ = report.result.odometry;
  end_ns_ = report.turn.end_ns();

  server_.publish(MessageClass::kPose, line_.pose(pose, map_ ? &map_->plan() : nullptr));
  if (server_.is_watched(MessageClass::kScan)) {
    server_.publish(MessageClass::kScan, line_.scan(report.turn));
  }
  if (server_.is_watched(MessageClass::kBreakpoints)) {
    server_.publish(MessageClass::kBreakpoints,
                    line_.breakpoints(report.turn.start_ns(), report.result.detection));
  }
  if (pose.state != state_) publish_change(pose.state, pose.t_ns);
}

void TurnPublisher::publish_change(core::PoseState to, core::TimeNs t_ns) {
  using message::to_string;
  std::string change(state_ ? to_string(*state_) : "none");
  change.append(" -> ").append(to_string(to));
  spdlog::debug("pose {}", change);
  server_.publish(MessageClass::kEvent, line_.event(t_ns, "state change", change));
  state_ = to;
}

}  // namespace cornerd::daemon
