// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <memory>
#include <span>

#include "core/map/wall_map.hpp"
#include "core/sensor_noise.hpp"
#include "survey/drive_mapper.hpp"
#include "survey/wall_building.hpp"

namespace cornerd::survey {

/// The part of a drive that some of its turns are, numbered from 0 on, with the faces that they saw
/// as far as they saw them. Without links. `turns`: ascending.
MappedDrive part_of(const MappedDrive& drive, std::span<const std::uint32_t> scans);

/// The walls that some turns of a drive saw, in the drive's frame; null where they saw none.
std::shared_ptr<const core::WallMap> map_seen_by(const MappedDrive& drive,
                                                 std::span<const std::uint32_t> scans,
                                                 const core::SensorNoise& noise,
                                                 const WallLimits& limits);

}  // namespace cornerd::survey
