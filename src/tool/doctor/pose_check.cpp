// SPDX-License-Identifier: MIT
#include <numeric>

#include "message/line_writer.hpp"
#include "tool/doctor/checks.hpp"

namespace cornerd::tool {

namespace {

std::uint64_t poses_in(const DaemonView& daemon, core::PoseState state) {
  return daemon.poses[static_cast<std::size_t>(state)];
}

/// "6 fix, 2 lost"
std::string describe_poses(const DaemonView& daemon) {
  std::string text;
  for (std::size_t i = 0; i < daemon.poses.size(); ++i) {
    if (daemon.poses[i] == 0) continue;
    text += (text.empty() ? "" : ", ") + std::to_string(daemon.poses[i]) + ' ' +
            std::string(message::to_string(static_cast<core::PoseState>(i)));
  }
  return text;
}

}  // namespace

std::vector<Finding> check_poses(const Patient& patient) {
  const DaemonView& daemon = patient.daemon;
  if (!daemon.status || daemon.status->lidar_state != "running") return {};
  const std::uint64_t all =
      std::accumulate(daemon.poses.begin(), daemon.poses.end(), std::uint64_t{0});
  if (all == 0) {
    return {{Verdict::kWrong,
             "poses",
             "none came, although the lidar runs",
             {"try again in a few seconds: the first scan may not be complete"}}};
  }
  const std::string what = "of the last scans: " + describe_poses(daemon);
  const std::uint64_t lost = poses_in(daemon, core::PoseState::kLost);
  const std::uint64_t ambiguous = poses_in(daemon, core::PoseState::kAmbiguous);
  if (2 * (lost + ambiguous) <= all) return {{Verdict::kGood, "poses", what}};
  if (ambiguous > lost) {
    return {{Verdict::kWrong,
             "poses",
             what,
             {"the map has look-alike places: cornerctl map check " + patient.config.map.string() +
                  " lists them",
              "add details that break the symmetry to the map, or send the pose: SET_POSE on the "
              "control socket"}}};
  }
  return {
      {Verdict::kWrong,
       "poses",
       what,
       {"check that the map is right and the robot inside it: cornerctl monitor shows both",
        "check lidar.mount: theta if the scan is rotated, inverted if it is mirrored",
        "check that the walls are where the map has them, to a few centimetres, and not hidden"}}};
}

}  // namespace cornerd::tool
