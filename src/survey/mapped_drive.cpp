// SPDX-License-Identifier: MIT
#include "survey/mapped_drive.hpp"

#include <algorithm>

namespace cornerd::survey {

std::span<const MatchedObservation> MappedDrive::observations_of(std::size_t scan) const {
  const auto first = std::partition_point(
      observations.begin(), observations.end(),
      [&](const MatchedObservation& observation) { return observation.scan < scan; });
  const auto last = std::partition_point(
      first, observations.end(),
      [&](const MatchedObservation& observation) { return observation.scan == scan; });
  return {first, last};
}

void measure_faces(MappedDrive& drive) {
  for (LineLandmark& face : drive.faces) face.observations = 0;
  for (const MatchedObservation& observation : drive.observations) {
    LineLandmark& face = drive.faces[observation.face];
    const core::Pose2& T_map_lidar = drive.T_map_lidar[observation.scan];
    if (face.observations == 0) {
      const PlacedObservation placed(observation.seen, T_map_lidar);
      face.set_extent(face.along_of(placed.first), face.along_of(placed.last));
      face.first_scan = observation.scan;
    }
    face.see(observation.seen, T_map_lidar, observation.scan);
  }
}

std::vector<double> travelled_m(const MappedDrive& drive) {
  std::vector<double> travelled(drive.T_map_lidar.size(), 0);
  for (std::size_t scan = 1; scan < travelled.size(); ++scan) {
    travelled[scan] =
        travelled[scan - 1] +
        (drive.T_map_lidar[scan].translation() - drive.T_map_lidar[scan - 1].translation()).norm();
  }
  return travelled;
}

}  // namespace cornerd::survey
