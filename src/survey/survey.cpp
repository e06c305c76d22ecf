// SPDX-License-Identifier: MIT
#include "survey/survey.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

#include "survey/adjustment.hpp"
#include "survey/face_evidence.hpp"
#include "survey/right_angles.hpp"
#include "survey/validity_checks.hpp"
#include "survey/wall_building.hpp"

namespace cornerd::survey {
namespace {

/// Returns that are kept for pictures.
constexpr std::size_t kPicturePoints = 60'000;

std::vector<core::Vec2> picture_points(const MappedDrive& drive) {
  std::vector<core::Vec2> points;
  const std::size_t step = drive.points.size() / kPicturePoints + 1;
  for (std::size_t scan = 0; scan < drive.T_map_lidar.size(); ++scan) {
    for (std::size_t i = drive.first_point[scan]; i < drive.first_point[scan + 1]; ++i) {
      if (i % step != 0) continue;
      const DeskewedPoint& point = drive.points[i];
      points.push_back(drive.T_map_lidar[scan] *
                       core::Vec2(point.range_m * core::unit_vector(point.bearing_rad)));
    }
  }
  return points;
}

/// Parts of the pieces without hits.
std::vector<ThinPlace> thin_places(const MappedDrive& drive,
                                   const std::vector<FaceEvidence>& evidence,
                                   const std::vector<WallPiece>& pieces) {
  constexpr double kMinThin_m = 0.05;
  std::vector<ThinPlace> thin;
  for (const WallPiece& piece : pieces) {
    const LineLandmark& face = drive.faces[piece.face];
    const FaceEvidence& seen = evidence[piece.face];
    double from_m = piece.begin_m;
    const auto close = [&](double to_m) {
      if (to_m - from_m > kMinThin_m) thin.push_back({face.at(from_m), face.at(to_m)});
    };
    for (std::size_t cell = 0; cell < seen.size(); ++cell) {
      if (!seen.is_wall(cell)) continue;
      const double begin_m = seen.along_of(cell);
      if (begin_m > piece.end_m) break;
      close(begin_m);
      from_m = std::max(from_m, begin_m + FaceEvidence::kCell_m);
    }
    close(piece.end_m);
  }
  return thin;
}

/// Merges faces of one wall by the ray evidence, until nothing is left to merge.
std::size_t merge_until_stable(MappedDrive& drive, const SurveyConfig& config,
                               ProgressShares& shares, double begin, double end) {
  constexpr int kMaxRounds = 3;
  std::size_t merged = 0;
  for (int round = 0; round < kMaxRounds; ++round) {
    const auto from = [&](int done) { return begin + (end - begin) * done / kMaxRounds; };
    const auto evidence = gather_evidence(
        drive, config.sensor.noise, shares.pass("merging walls", from(round), from(round + 1)));
    const std::size_t now = merge_faces(drive, evidence, config.merging);
    if (now == 0) break;
    merged += now;
    adjust(drive);
  }
  return merged;
}

/// Indices of the faces that have a wall piece, each once.
std::vector<std::uint32_t> faces_of(const std::vector<WallPiece>& pieces) {
  std::vector<std::uint32_t> faces;
  for (const WallPiece& piece : pieces) faces.push_back(piece.face);
  std::sort(faces.begin(), faces.end());
  faces.erase(std::unique(faces.begin(), faces.end()), faces.end());
  return faces;
}

/// Surveys by the lidar alone a drive whose odometry was rejected.
SurveyResult survey_without_odometry(const RecordedDrive& recorded, RejectedOdometry rejected,
                                     const SurveyConfig& config, const SurveyProgress& progress) {
  try {
    SurveyResult result = survey(recorded.without_odometry(), config, progress);
    measure_wheel_distances(recorded, result.T_map_base, config.sensor.odometry, rejected);
    result.rejected_odometry = rejected;
    return result;
  } catch (const std::invalid_argument& refused) {
    throw std::invalid_argument(
        "the odometry contradicts the lidar in " + std::to_string(rejected.contradicted_scans) +
        " and is missing in " + std::to_string(rejected.scans_without_odometry) + " of " +
        std::to_string(recorded.size()) +
        " scans: check the encoders and odometry.counts_per_turn. The lidar alone gives no map "
        "either: " +
        refused.what());
  }
}

}  // namespace

SurveyResult survey(const RecordedDrive& recorded, const SurveyConfig& config,
                    const SurveyProgress& progress) {
  check_scan_count(recorded, config.walls.pieces.observations);
  const std::size_t scans = recorded.size();
  ProgressShares shares(progress, scans);
  SurveyResult result;

  // First pass: the trajectory, and the odometry's calibration.
  const double half = recorded.has_wheels() ? 0.3 : 0.15;
  MappedDrive first = map_drive(recorded, config.sensor, nullptr, shares.pass("tracking", 0, half));
  check_pauses(recorded, first);
  if (!first.has_odometry) {
    // The scans were deskewed by extrapolated motions. Repeat the pass with the motions that it
    // found, and without its map, which the motion distortion has tilted.
    adjust(first);
    first = map_drive(recorded, config.sensor, &first, shares.pass("tracking", half, 0.3),
                      /*anew=*/true);
  }
  if (exceeds_rejection_share(first.contradicted_scans + first.scans_without_odometry, scans)) {
    RejectedOdometry rejected;
    rejected.contradicted_scans = first.contradicted_scans;
    rejected.scans_without_odometry = first.scans_without_odometry;
    return survey_without_odometry(recorded, rejected, config, shares.rest());
  }
  result.unmatched_scans = first.unmatched_scans;
  result.degenerate_scans = first.degenerate_scans;
  if (first.faces.empty()) {
    throw std::invalid_argument(
        "the recording shows no straight walls: check that the lidar's ranges are not empty "
        "(cornerctl replay --classes SCAN)");
  }
  check_overlap(recorded, first);
  adjust(first);
  result.merged_faces = merge_faces(first, {}, config.merging);
  adjust(first);
  if (config.close_loops) {
    result.loops = close_loops(first, config.sensor, config.merging, config.walls,
                               result.merged_faces, shares.pass("closing loops", 0.3, 0.4));
  }
  check_degenerate_scans(recorded, result.degenerate_scans, result.loops);
  result.merged_faces += merge_until_stable(first, config, shares, 0.4, 0.5);

  // Second pass: scans deskewed by the calibrated odometry and matched to the adjusted map.
  MappedDrive drive = map_drive(recorded, config.sensor, &first, shares.pass("mapping", 0.5, 0.75));
  first = {};
  result.merged_faces += merge_faces(drive, {}, config.merging);
  AdjustmentResult fit = adjust(drive);
  result.merged_faces += merge_until_stable(drive, config, shares, 0.75, 0.9);
  std::vector<FaceEvidence> evidence =
      gather_evidence(drive, config.sensor.noise, shares.pass("building walls", 0.9, 1));

  // From faces to walls, after an adjustment that makes both faces of a wall parallel.
  std::vector<DroppedPiece> ignored;
  const std::vector<WallPiece> pieces = cut_pieces(drive, evidence, config.walls.pieces, ignored);
  std::vector<FaceConstraint> constraints =
      parallel_constraints(drive, pieces, pair_sides(drive, pieces, config.walls.solids));
  if (config.manhattan) {
    const RightAngles square = right_angles(drive, faces_of(pieces));
    constraints.insert(constraints.end(), square.constraints.begin(), square.constraints.end());
    result.squared = {square.constraints.size() + 1, square.askew};
  }
  fit = adjust(drive, constraints);
  BuiltWalls built = build_walls_of(drive, evidence, config.walls, result.dropped);
  result.duplicate_m = duplicate_walls_m(drive, evidence, built.pieces);
  result.plan.walls = std::move(built.walls);
  if (result.plan.walls.empty()) {
    throw std::invalid_argument(
        "no wall has enough returns to be mapped: drive more slowly, and see each wall in several "
        "scans");
  }
  if (!drive.has_odometry) check_duplicate_walls(result.duplicate_m, result.plan.walls);
  result.free_space_conflicts = free_space_conflicts(evidence, built.pieces);
  check_free_space_conflicts(result.free_space_conflicts);

  result.thin = thin_places(drive, evidence, built.pieces);
  result.points = picture_points(drive);
  const core::Pose2 T_lidar_base = config.sensor.T_base_lidar.inverse();
  for (std::size_t scan = 0; scan < scans; ++scan) {
    result.T_map_base.push_back(drive.T_map_lidar[scan] * T_lidar_base);
    result.t_ns.push_back(recorded.middle_ns(scan));
  }
  result.discarded_faces = drive.discarded_faces;
  result.observations = drive.observations.size();
  result.outliers = fit.outliers;
  result.sigma = fit.sigma;
  result.has_odometry = drive.has_odometry;
  result.has_gyro = drive.has_odometry && recorded.has_gyro();
  result.learned = drive.learned;
  return result;
}

void move_frame(const core::Pose2& T_new_map, SurveyResult& result) {
  for (core::Wall& wall : result.plan.walls) {
    wall.from = T_new_map * wall.from;
    wall.to = T_new_map * wall.to;
  }
  for (core::Pose2& pose : result.T_map_base) pose = T_new_map * pose;
  for (core::Vec2& point : result.points) point = T_new_map * point;
  for (ThinPlace& place : result.thin) place = {T_new_map * place.from, T_new_map * place.to};
  for (DroppedPiece& piece : result.dropped) {
    piece.from = T_new_map * piece.from;
    piece.to = T_new_map * piece.to;
  }
}

}  // namespace cornerd::survey
