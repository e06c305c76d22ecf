// SPDX-License-Identifier: MIT
#include "survey/mapped_drive.hpp"

#include <algorithm>

namespace cornerd::survey {

std::span<const Observation> MappedDrive::observations_of(std::size_t turn) const {
  const auto first =
      std::partition_point(observations.begin(), observations.end(),
                           [&](const Observation& observation) { return observation.turn < turn; });
  const auto last = std::partition_point(
      first, observations.end(),
      [&](const Observation& observation) { return observation.turn == turn; });
  return {first, last};
}

void measure_faces(MappedDrive& drive) {
  for (MappedFace& face : drive.faces) face.sightings = 0;
  for (const Observation& observation : drive.observations) {
    MappedFace& face = drive.faces[observation.face];
    const core::Pose2& T_map_lidar = drive.T_map_lidar[observation.turn];
    if (face.sightings == 0) {
      const PlacedSighting placed(observation.seen, T_map_lidar);
      face.set_extent(face.along_of(placed.first), face.along_of(placed.last));
      face.first_turn = observation.turn;
    }
    face.see(observation.seen, T_map_lidar, observation.turn);
  }
}

std::vector<double> ways_m(const MappedDrive& drive) {
  std::vector<double> ways(drive.T_map_lidar.size(), 0);
  for (std::size_t turn = 1; turn < ways.size(); ++turn) {
    ways[turn] =
        ways[turn - 1] +
        (drive.T_map_lidar[turn].translation() - drive.T_map_lidar[turn - 1].translation()).norm();
  }
  return ways;
}

}  // namespace cornerd::survey
