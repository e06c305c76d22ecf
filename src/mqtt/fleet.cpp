// SPDX-License-Identifier: MIT
#include "mqtt/fleet.hpp"

#include <algorithm>

namespace cornerd::mqtt {

void Fleet::take(const Message& message, double now_s, UnixTime now) {
  const std::string start = "cornerd/" + site_ + "/robot/";
  if (!message.topic.starts_with(start)) return;
  if (message.payload.empty()) {  // taken back
    robots_.erase(message.topic);
    return;
  }
  auto report = parse_robot_report(message.payload);
  if (!report || message.topic != start + report->manufacturer + "/" + report->serial) return;
  if (robots_.size() >= kMaxRobots && !robots_.contains(message.topic)) return;
  double age_s = 0;
  if (message.is_retained) {
    const std::chrono::duration<double> unix_s = now.time_since_epoch();
    age_s = std::max(unix_s.count() - core::to_seconds(report->t_ns), 0.0);
  }
  robots_[message.topic] = {std::move(*report), now_s - age_s};
}

std::vector<Fleet::Robot> Fleet::robots(double now_s) const {
  std::vector<Robot> robots;
  for (const auto& [topic, entry] : robots_) {
    robots.push_back({entry.report, now_s - entry.written_s});
  }
  return robots;
}

}  // namespace cornerd::mqtt
