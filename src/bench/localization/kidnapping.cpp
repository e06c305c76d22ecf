// SPDX-License-Identifier: MIT
#include "bench/localization/kidnapping.hpp"

#include <algorithm>

#include "core/localizer.hpp"
#include "replay/pose_error.hpp"
#include "replay/simulator/random_poses.hpp"
#include "replay/simulator/scan_simulator.hpp"

namespace cornerd::bench {
namespace {

constexpr std::size_t kKidnappingSamples = 800;
constexpr double kKidnappingClearance_m = 0.15;

}  // namespace

KidnappingScore run_kidnapping(const std::vector<std::shared_ptr<const core::WallMap>>& maps,
                               std::size_t jumps, std::uint64_t seed,
                               const std::function<void(std::size_t done)>& progress) {
  KidnappingScore score;
  for (std::size_t m = 0; m < maps.size(); ++m) {
    const core::WallMap& map = *maps[m];
    const std::size_t share = jumps * (m + 1) / maps.size() - jumps * m / maps.size();
    replay::ScanSimulator lidar({}, kKidnappingSamples, seed + m);
    core::Localizer localizer(maps[m], {});
    core::TimeNs t_ns = 0;
    const auto poses = replay::random_poses(map, share + 1, kKidnappingClearance_m, seed + m);
    for (std::size_t i = 0; i < poses.size(); ++i) {
      const core::Pose2& place = poses[i];
      std::size_t recovered = KidnappingScore::kScans;
      for (std::size_t k = 0; k < KidnappingScore::kScans; ++k) {
        const core::Scan& scan = lidar.take(map, t_ns, replay::stand_still(place));
        t_ns += lidar.scan_ns();
        const core::PoseEstimate& pose = localizer.step(scan).pose;
        if (i == 0 || !core::has_pose(pose.state)) continue;
        if (replay::is_right(pose.T_map_base, place)) {
          recovered = std::min(recovered, k);
        } else {
          ++(k == 0 ? score.wrong_first : score.wrong_later);
        }
      }
      if (i == 0) continue;  // the start
      ++score.jumps;
      if (recovered < KidnappingScore::kScans) {
        ++score.recovered[recovered];
      } else {
        ++score.never;
      }
      if (progress) progress(score.jumps);
    }
  }
  return score;
}

}  // namespace cornerd::bench
