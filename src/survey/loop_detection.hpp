// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "core/localizer_config.hpp"
#include "core/map/wall_map.hpp"
#include "core/sensor_noise.hpp"
#include "survey/drive_mapper.hpp"
#include "survey/wall_building.hpp"

namespace cornerd::survey {

/// The drive of the given scans alone (ascending indices), renumbered from 0, with the faces that
/// they observed. Without odometry edges.
MappedDrive subset_of(const MappedDrive& drive, std::span<const std::uint32_t> scans);

/// The walls that the given scans observed, in the drive's frame; null where there are none.
std::shared_ptr<const core::WallMap> map_from_scans(const MappedDrive& drive,
                                                    std::span<const std::uint32_t> scans,
                                                    const core::SensorNoise& noise,
                                                    const WallLimits& limits);

/// A segment of a drive that was localized in a map made of much earlier scans.
struct LoopCandidate {
  std::vector<LoopConstraint> loop_constraints;  ///< of the scans that agree, ascending
  core::Pose2 T_now_then;  ///< drift: the middle constraint's later scan, estimated to localized
  std::size_t tried = 0;   ///< scans that were tried
  std::size_t recognised = 0;  ///< scans that were localized
};

/// Scans in a segment.
inline constexpr std::size_t kSegmentScans = 60;

/// Shortest loop, in distance travelled: on a shorter one the walls stay in view.
inline constexpr double kMinLoop_m = 5;

/// Detects a loop that the segment from scan `begin` on closes and scan matching missed. The
/// segment must show new walls. Its scans are localized, without a prior, in a map made of the
/// scans that were near long before; several of them have to agree with the drive's relative poses.
std::optional<LoopCandidate> find_loop(const MappedDrive& drive, std::size_t begin,
                                       const core::LocalizerConfig& sensor,
                                       const WallLimits& limits);

}  // namespace cornerd::survey
