// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "core/odometry/odometry_config.hpp"
#include "survey/line_landmark.hpp"

namespace cornerd::survey {

/// A line observation and the face that it was associated with.
struct MatchedObservation {
  std::uint32_t scan = 0;
  std::uint32_t face = kNoFace;
  LineObservation seen;
};

/// Relative pose from one scan to the next, by odometry or by a constant-velocity model.
struct OdometryEdge {
  core::Pose2 T_before_now;
  core::Covariance3 covariance = core::Covariance3::Identity();  ///< in the earlier frame
};

/// Loop closure: a later scan was localized relative to an earlier one.
struct LoopConstraint {
  std::uint32_t earlier = 0;  ///< scan indices
  std::uint32_t later = 0;
  core::Pose2 T_earlier_later;
  double sigma_m = 0;
  double sigma_rad = 0;
};

/// A return in the lidar frame at the middle of its scan.
struct DeskewedPoint {
  float bearing_rad = 0;
  float range_m = 0;
};

/// Result of one mapping pass: the input of the adjustment.
struct MappedDrive {
  std::vector<core::Pose2> T_map_lidar;  ///< of each scan
  std::vector<OdometryEdge>
      odometry_edges;  ///< odometry_edges[i]: from scan i - 1 to scan i; [0] is unused
  std::vector<LoopConstraint> loop_constraints;  ///< of loops that were closed
  std::vector<LineLandmark> faces;
  std::vector<MatchedObservation> observations;
  std::vector<std::size_t> unmatched_scans;  ///< scan matching found no pose
  /// First scans after a pause of lidar and odometry that do not match the place before it.
  std::vector<std::size_t> displaced_scans;
  /// Without odometry: the walls leave one direction unobservable, which was extrapolated.
  std::vector<std::size_t> degenerate_scans;
  /// Of a drive with odometry: scans that it does not predict, since it contradicts the lidar, or
  /// since readings are missing.
  std::size_t contradicted_scans = 0;
  std::size_t scans_without_odometry = 0;
  std::size_t discarded_faces = 0;  ///< observed too rarely
  std::optional<core::OdometryParameters> learned;
  bool has_odometry = false;

  /// Observations are sorted by scan.
  std::span<const MatchedObservation> observations_of(std::size_t scan) const;

  /// Returns of all scans, each sorted by bearing; scan i: [first_point[i], first_point[i + 1]).
  std::vector<DeskewedPoint> points;
  std::vector<std::size_t> first_point;
  std::span<const DeskewedPoint> points_of(std::size_t scan) const {
    return std::span(points).subspan(first_point[scan], first_point[scan + 1] - first_point[scan]);
  }
};

/// Recomputes each face's extent, number of observations, and first and last scan.
void measure_faces(MappedDrive& drive);

/// Distance travelled up to each scan, metres.
std::vector<double> travelled_m(const MappedDrive& drive);

}  // namespace cornerd::survey
