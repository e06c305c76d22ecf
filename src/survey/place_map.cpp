// SPDX-License-Identifier: MIT
#include "survey/place_map.hpp"

#include <utility>
#include <vector>

#include "survey/evidence.hpp"

namespace cornerd::survey {

MappedDrive part_of(const MappedDrive& drive, std::span<const std::uint32_t> scans) {
  MappedDrive part;
  part.has_odometry = drive.has_odometry;
  part.first_point.push_back(0);
  std::vector<std::uint32_t> place_of(drive.faces.size(), kNoFace);
  for (const std::uint32_t scan : scans) {
    const auto number = static_cast<std::uint32_t>(part.T_map_lidar.size());
    part.T_map_lidar.push_back(drive.T_map_lidar[scan]);
    const auto points = drive.points_of(scan);
    part.points.insert(part.points.end(), points.begin(), points.end());
    part.first_point.push_back(part.points.size());
    for (Observation observation : drive.observations_of(scan)) {
      std::uint32_t& place = place_of[observation.face];
      if (place == kNoFace) {
        place = static_cast<std::uint32_t>(part.faces.size());
        part.faces.push_back(drive.faces[observation.face]);
      }
      observation.scan = number;
      observation.face = place;
      part.observations.push_back(observation);
    }
  }
  measure_faces(part);
  return part;
}

std::shared_ptr<const core::WallMap> map_seen_by(const MappedDrive& drive,
                                                 std::span<const std::uint32_t> scans,
                                                 const core::SensorNoise& noise,
                                                 const WallLimits& limits) {
  const MappedDrive part = part_of(drive, scans);
  const std::vector<FaceEvidence> evidence = gather_evidence(part, noise, {});
  std::vector<Dropped> dropped;
  core::FloorPlan plan;
  plan.walls = build_walls_of(part, evidence, limits, dropped).walls;
  if (plan.walls.empty()) return nullptr;
  return std::make_shared<const core::WallMap>(std::move(plan));
}

}  // namespace cornerd::survey
