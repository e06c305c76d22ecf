// SPDX-License-Identifier: MIT
#include "survey/survey.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

#include "survey/adjustment.hpp"
#include "survey/doubled_walls.hpp"
#include "survey/evidence.hpp"
#include "survey/refusals.hpp"
#include "survey/right_angles.hpp"
#include "survey/wall_building.hpp"

namespace cornerd::survey {
namespace {

/// Points that are kept for pictures.
constexpr std::size_t kPicturePoints = 60'000;

std::vector<core::Vec2> picture_points(const MappedDrive& drive) {
  std::vector<core::Vec2> points;
  const std::size_t step = drive.points.size() / kPicturePoints + 1;
  for (std::size_t scan = 0; scan < drive.T_map_lidar.size(); ++scan) {
    for (std::size_t i = drive.first_point[scan]; i < drive.first_point[scan + 1]; ++i) {
      if (i % step != 0) continue;
      const StraightPoint& point = drive.points[i];
      points.push_back(drive.T_map_lidar[scan] *
                       core::Vec2(point.range_m * core::unit_vector(point.bearing_rad)));
    }
  }
  return points;
}

/// Stretches of the pieces that were prolonged to a corner, or bridged.
std::vector<ThinPlace> thin_places(const MappedDrive& drive,
                                   const std::vector<FaceEvidence>& evidence,
                                   const std::vector<WallPiece>& pieces) {
  constexpr double kWorthSaying_m = 0.05;
  std::vector<ThinPlace> thin;
  for (const WallPiece& piece : pieces) {
    const MappedFace& face = drive.faces[piece.face];
    const FaceEvidence& seen = evidence[piece.face];
    double from_m = piece.begin_m;
    const auto close = [&](double to_m) {
      if (to_m - from_m > kWorthSaying_m) thin.push_back({face.at(from_m), face.at(to_m)});
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

/// Merges what the rays say is one wall, until nothing is left to merge.
std::size_t unite(MappedDrive& drive, const SurveyConfig& config, ProgressShares& shares,
                  double begin, double end) {
  constexpr int kMostRounds = 3;
  std::size_t merged = 0;
  for (int round = 0; round < kMostRounds; ++round) {
    const auto from = [&](int done) { return begin + (end - begin) * done / kMostRounds; };
    const auto evidence = gather_evidence(
        drive, config.sensor.noise, shares.pass("one wall or two", from(round), from(round + 1)));
    const std::size_t now = merge_faces(drive, evidence, config.merging);
    if (now == 0) break;
    merged += now;
    adjust(drive);
  }
  return merged;
}

/// The faces that some piece of wall is of, each once.
std::vector<std::uint32_t> faces_of(const std::vector<WallPiece>& pieces) {
  std::vector<std::uint32_t> faces;
  for (const WallPiece& piece : pieces) faces.push_back(piece.face);
  std::sort(faces.begin(), faces.end());
  faces.erase(std::unique(faces.begin(), faces.end()), faces.end());
  return faces;
}

/// A drive whose wheels lie or say nothing, by the lidar alone.
SurveyResult survey_without_wheels(const RecordedDrive& recorded, OdometryDoubt doubt,
                                   const SurveyConfig& config, const SurveyProgress& progress) {
  try {
    SurveyResult result = survey(recorded.without_odometry(), config, progress);
    measure_wheels(recorded, result.T_map_base, config.sensor.odometry, doubt);
    result.odometry_doubt = doubt;
    return result;
  } catch (const std::invalid_argument& refused) {
    throw std::invalid_argument(
        "of " + std::to_string(recorded.size()) + " turns the odometry contradicts the lidar in " +
        std::to_string(doubt.contradicted_scans) + " and is missing in " +
        std::to_string(doubt.scans_without_odometry) +
        " (are the encoders and odometry.counts_per_turn right?); and " + refused.what());
  }
}

}  // namespace

SurveyResult survey(const RecordedDrive& recorded, const SurveyConfig& config,
                    const SurveyProgress& progress) {
  refuse_too_few_scans(recorded, config.walls.pieces.sightings);
  const std::size_t scans = recorded.size();
  ProgressShares shares(progress, scans);
  SurveyResult result;

  // First pass: find the way, and learn the wheels and the gyro.
  const double half = recorded.has_wheels() ? 0.3 : 0.15;
  MappedDrive first =
      map_drive(recorded, config.sensor, nullptr, shares.pass("finding the way", 0, half));
  refuse_pauses(recorded, first);
  if (!first.has_odometry) {
    // Its turns were straightened by guesses. The way that they gave tells the motion of each; what
    // was mapped with them is of no use any more.
    adjust(first);
    first = map_drive(recorded, config.sensor, &first, shares.pass("finding the way", half, 0.3),
                      /*anew=*/true);
  }
  if (are_too_many(first.contradicted_scans + first.scans_without_odometry, scans)) {
    OdometryDoubt doubt;
    doubt.contradicted_scans = first.contradicted_scans;
    doubt.scans_without_odometry = first.scans_without_odometry;
    return survey_without_wheels(recorded, doubt, config, shares.rest());
  }
  result.unmatched_scans = first.unmatched_scans;
  result.degenerate_scans = first.degenerate_scans;
  if (first.faces.empty()) throw std::invalid_argument("no walls were seen");
  refuse_without_overlap(recorded, first);
  adjust(first);
  result.merged_faces = merge_faces(first, {}, config.merging);
  adjust(first);
  if (config.close_loops) {
    result.loops = close_loops(first, config.sensor, config.merging, config.walls,
                               result.merged_faces, shares.pass("closing loops", 0.3, 0.4));
  }
  refuse_unchecked_guesses(recorded, result.degenerate_scans, result.loops);
  result.merged_faces += unite(first, config, shares, 0.4, 0.5);

  // Second pass: the turns straightened by what was learned, and matched to the adjusted map.
  MappedDrive drive = map_drive(recorded, config.sensor, &first, shares.pass("mapping", 0.5, 0.75));
  first = {};
  result.merged_faces += merge_faces(drive, {}, config.merging);
  AdjustmentResult fit = adjust(drive);
  result.merged_faces += unite(drive, config, shares, 0.75, 0.9);
  std::vector<FaceEvidence> evidence =
      gather_evidence(drive, config.sensor.noise, shares.pass("building walls", 0.9, 1));

  // From faces to walls, which first tell what pairs of sides say, all at once with the drive.
  std::vector<Dropped> ignored;
  const std::vector<WallPiece> pieces = cut_pieces(drive, evidence, config.walls.pieces, ignored);
  std::vector<FaceBond> bonds =
      bonds_of(drive, pieces, pair_sides(drive, pieces, config.walls.solids));
  if (config.manhattan) {
    const RightAngles square = right_angles(drive, faces_of(pieces));
    bonds.insert(bonds.end(), square.bonds.begin(), square.bonds.end());
    result.squared = {square.bonds.size() + 1, square.askew};
  }
  fit = adjust(drive, bonds);
  BuiltWalls built = build_walls_of(drive, evidence, config.walls, result.dropped);
  result.doubled_m = doubled_walls_m(drive, evidence, built.pieces);
  result.plan.walls = std::move(built.walls);
  if (result.plan.walls.empty()) {
    throw std::invalid_argument("no wall was seen well enough to be believed");
  }
  if (!drive.has_odometry) refuse_doubled_walls(result.doubled_m, result.plan.walls);
  result.through = seen_through(evidence, built.pieces);
  refuse_seen_through(result.through);

  result.thin = thin_places(drive, evidence, built.pieces);
  result.points = picture_points(drive);
  const core::Pose2 T_lidar_base = config.sensor.T_base_lidar.inverse();
  for (std::size_t scan = 0; scan < scans; ++scan) {
    result.T_map_base.push_back(drive.T_map_lidar[scan] * T_lidar_base);
    result.t_ns.push_back(recorded.middle_ns(scan));
  }
  result.forgotten_faces = drive.forgotten_faces;
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
  for (Dropped& piece : result.dropped) {
    piece.from = T_new_map * piece.from;
    piece.to = T_new_map * piece.to;
  }
}

}  // namespace cornerd::survey
