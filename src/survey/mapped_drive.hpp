// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "core/odometry/odometry_config.hpp"
#include "survey/mapped_face.hpp"

namespace cornerd::survey {

/// One wall of one turn, and the face that it was taken for.
struct Observation {
  std::uint32_t scan = 0;
  std::uint32_t face = kNoFace;
  Sighting seen;
};

/// The way from one turn to the next by wheels and gyro, or by what a robot can do at all.
struct DriveLink {
  core::Pose2 T_before_now;
  core::Covariance3 covariance = core::Covariance3::Identity();  ///< in the frame of the earlier
};

/// A later turn that was recognised at a place where an earlier one had been.
struct PlaceTie {
  std::uint32_t earlier = 0;  ///< turns
  std::uint32_t later = 0;
  core::Pose2 T_earlier_later;
  double sigma_m = 0;
  double sigma_rad = 0;
};

/// A return in the frame of the lidar in the middle of its turn.
struct StraightPoint {
  float bearing_rad = 0;
  float range_m = 0;
};

/// What one pass through a drive gave: all that the adjustment asks for.
struct MappedDrive {
  std::vector<core::Pose2> T_map_lidar;  ///< of each turn
  std::vector<DriveLink> links;          ///< links[i]: from turn i - 1 to turn i; [0] is none
  std::vector<PlaceTie> ties;            ///< of loops that were closed
  std::vector<MappedFace> faces;
  std::vector<Observation> observations;
  std::vector<std::size_t> unmatched_scans;  ///< whose walls did not tell where they are
  /// The first ones after a pause of turns and readings, which show another place than the last
  /// ones before it.
  std::vector<std::size_t> lost_scans;
  /// Without odometry: whose walls told nothing of one direction, in which a guess stands.
  std::vector<std::size_t> degenerate_scans;
  /// Of a drive with odometry, turns that it did not lead to: as wheels and lidar had told
  /// different stories, and as readings were missing.
  std::size_t contradicted_scans = 0;
  std::size_t scans_without_odometry = 0;
  std::size_t forgotten_faces = 0;  ///< begun, but never seen again
  std::optional<core::LearnedOdometry> learned;
  bool has_odometry = false;

  /// In the order of the turns, as all observations are.
  std::span<const Observation> observations_of(std::size_t scan) const;

  /// Returns of all turns by bearing, one turn after another; turn i: [first_point[i],
  /// first_point[i + 1]).
  std::vector<StraightPoint> points;
  std::vector<std::size_t> first_point;
  std::span<const StraightPoint> points_of(std::size_t scan) const {
    return std::span(points).subspan(first_point[scan], first_point[scan + 1] - first_point[scan]);
  }
};

/// What each face was seen of, anew: its extent, its number of sightings, its first and last turn.
void measure_faces(MappedDrive& drive);

/// The robot's way up to each turn, metres.
std::vector<double> ways_m(const MappedDrive& drive);

}  // namespace cornerd::survey
