// SPDX-License-Identifier: MIT
#include <array>
#include <cstdint>
#include <numeric>
#include <string>

#include "message/line_writer.hpp"
#include "tool/doctor/checks.hpp"

namespace cornerd::tool {

namespace {

std::uint64_t poses_in(const std::array<std::uint64_t, 5>& poses, core::PoseState state) {
  return poses[static_cast<std::size_t>(state)];
}

using Poses = decltype(DaemonView::poses);

/// "6 fix, 2 lost"
std::string describe_poses(const Poses& poses) {
  std::string text;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    if (poses[i] == 0) continue;
    text += (text.empty() ? "" : ", ") + std::to_string(poses[i]) + ' ' +
            std::string(message::to_string(static_cast<core::PoseState>(i)));
  }
  return text;
}

/// Of the scans since the daemon's start.
Poses poses_of_run(const message::ParsedStatus& status) {
  Poses poses{};
  for (std::size_t i = 0; i < poses.size(); ++i) {
    poses[i] =
        status.counter("poses_" + std::string(message::to_string(static_cast<core::PoseState>(i))));
  }
  return poses;
}

std::uint64_t count_of(const Poses& poses) {
  return std::accumulate(poses.begin(), poses.end(), std::uint64_t{0});
}

}  // namespace

std::vector<Finding> check_poses(const Patient& patient) {
  const DaemonView& daemon = patient.daemon;
  if (!daemon.status || daemon.status->lidar_state != "running") return {};
  if (count_of(daemon.poses) == 0) {
    return {{Verdict::kWrong,
             "poses",
             "none came, although the lidar runs",
             {"try again in a few seconds: the first scan may not be complete"}}};
  }
  // Two seconds of scans may all be of one bad place, or of one good one.
  const Poses run = poses_of_run(*daemon.status);
  const Poses& judged = count_of(run) > count_of(daemon.poses) ? run : daemon.poses;
  const std::string what = "of the last scans: " + describe_poses(daemon.poses) +
                           (count_of(run) > 0 ? "; since the start: " + describe_poses(run) : "");
  const std::uint64_t all = count_of(judged);
  // Scans that fit nowhere, whether or not odometry carried the pose on.
  const std::uint64_t lost =
      poses_in(judged, core::PoseState::kLost) + poses_in(judged, core::PoseState::kPredicted);
  const std::uint64_t ambiguous = poses_in(judged, core::PoseState::kAmbiguous);
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
  return {{Verdict::kWrong,
           "poses",
           what,
           {"check that the map is right and the robot inside it: cornerctl monitor shows both",
            "check lidar.mount: theta if the scan is rotated, inverted if it is mirrored",
            "check that nothing covers the lidar, and that the walls are where the map has them, "
            "to a few centimetres"}}};
}

}  // namespace cornerd::tool
