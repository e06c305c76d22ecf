// SPDX-License-Identifier: MIT
#include "survey/survey.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

#include "survey/adjustment.hpp"
#include "survey/evidence.hpp"
#include "survey/right_angles.hpp"

namespace cornerd::survey {
namespace {

/// Points that are kept for pictures.
constexpr std::size_t kPicturePoints = 60'000;

/// Of one of the passes over all turns, as a share of the whole.
Progress part(const SurveyProgress& progress, double begin, double end, std::size_t turns) {
  if (!progress) return {};
  return [=](std::size_t turn) {
    progress(begin + (end - begin) * static_cast<double>(turn) / static_cast<double>(turns));
  };
}

std::vector<core::Vec2> picture_points(const MappedDrive& drive) {
  std::vector<core::Vec2> points;
  const std::size_t step = drive.points.size() / kPicturePoints + 1;
  for (std::size_t turn = 0; turn < drive.T_map_lidar.size(); ++turn) {
    for (std::size_t i = drive.first_point[turn]; i < drive.first_point[turn + 1]; ++i) {
      if (i % step != 0) continue;
      const StraightPoint& point = drive.points[i];
      points.push_back(drive.T_map_lidar[turn] *
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

/// Without odometry nothing else tells the way: a drive that lost it gives no map.
void refuse_without_overlap(const RecordedDrive& recorded, const MappedDrive& drive) {
  constexpr double kMostStrange = 0.02;
  const double strange = static_cast<double>(drive.strange_turns.size());
  if (drive.has_odometry || strange <= kMostStrange * static_cast<double>(recorded.size())) return;
  const double first_s =
      core::to_seconds(recorded.start_ns(drive.strange_turns.front()) - recorded.start_ns(0));
  throw std::invalid_argument(
      "without odometry, " + std::to_string(drive.strange_turns.size()) + " of " +
      std::to_string(recorded.size()) +
      " turns see too little of what was seen before them, the "
      "first " +
      std::to_string(std::llround(first_s)) +
      " s after the start; drive more slowly there, or record the odometry too");
}

/// Where walls along the way are all that is seen, the length of the way is a guess: only a place
/// beyond that is recognised again can show that it was good enough.
void refuse_unchecked_guesses(const RecordedDrive& recorded, const std::vector<std::size_t>& blind,
                              const std::vector<LoopReport>& loops) {
  constexpr double kMostBlind = 0.02;
  if (static_cast<double>(blind.size()) <= kMostBlind * static_cast<double>(recorded.size())) {
    return;
  }
  for (const LoopReport& loop : loops) {
    const auto inside = std::upper_bound(blind.begin(), blind.end(), loop.earlier);
    if (loop.closed() && inside != blind.end() && *inside < loop.later) return;
  }
  const double first_s = core::to_seconds(recorded.start_ns(blind.front()) - recorded.start_ns(0));
  throw std::invalid_argument(
      "without odometry, " + std::to_string(blind.size()) + " of " +
      std::to_string(recorded.size()) +
      " turns see walls that tell nothing of the way along them, the first " +
      std::to_string(std::llround(first_s)) +
      " s after the start, and no loop was closed that would tell it; record the odometry too");
}

/// Merges what the rays say is one wall, until nothing is left to merge.
std::size_t unite(MappedDrive& drive, const SurveyConfig& config, const Progress& progress) {
  constexpr int kMostRounds = 3;
  std::size_t merged = 0;
  for (int round = 0; round < kMostRounds; ++round) {
    const auto evidence = gather_evidence(drive, config.sensor.noise, progress);
    const std::size_t now = merge_faces(drive, evidence, config.merging);
    if (now == 0) break;
    merged += now;
    adjust(drive);
  }
  return merged;
}

}  // namespace

SurveyResult survey(const RecordedDrive& recorded, const SurveyConfig& config,
                    const SurveyProgress& progress) {
  if (recorded.size() == 0) throw std::invalid_argument("not one whole turn of a lidar in it");
  const std::size_t turns = recorded.size();
  SurveyResult result;

  // First pass: find the way, and learn the wheels and the gyro.
  const double half = recorded.readings().empty() ? 0.15 : 0.3;
  MappedDrive first = map_drive(recorded, config.sensor, nullptr, part(progress, 0, half, turns));
  if (!first.has_odometry) {
    // Its turns were straightened by guesses. The way that they gave tells the motion of each; what
    // was mapped with them is of no use any more.
    adjust(first);
    first = map_drive(recorded, config.sensor, &first, part(progress, half, 0.3, turns),
                      /*anew=*/true);
  }
  result.strange_turns = first.strange_turns;
  result.blind_turns = first.blind_turns;
  if (first.faces.empty()) throw std::invalid_argument("no walls were seen");
  refuse_without_overlap(recorded, first);
  adjust(first);
  result.merged_faces = merge_faces(first, {}, config.merging);
  adjust(first);
  if (config.close_loops) {
    result.loops =
        close_loops(first, config.sensor, config.merging, config.walls, result.merged_faces);
  }
  refuse_unchecked_guesses(recorded, result.blind_turns, result.loops);
  result.merged_faces += unite(first, config, part(progress, 0.35, 0.4, turns));

  // Second pass: the turns straightened by what was learned, and matched to the adjusted map.
  MappedDrive drive = map_drive(recorded, config.sensor, &first, part(progress, 0.45, 0.75, turns));
  first = {};
  result.merged_faces += merge_faces(drive, {}, config.merging);
  AdjustmentResult fit = adjust(drive);
  result.merged_faces += unite(drive, config, part(progress, 0.8, 0.9, turns));
  std::vector<FaceEvidence> evidence =
      gather_evidence(drive, config.sensor.noise, part(progress, 0.9, 1, turns));

  // From faces to walls: cut, join, pair, and once more all at once with what the pairs say.
  std::vector<Dropped> ignored;
  std::vector<WallPiece> pieces = cut_pieces(drive, evidence, config.walls.pieces, ignored);
  std::vector<FaceBond> bonds =
      bonds_of(drive, pieces, pair_sides(drive, pieces, config.walls.solids));
  if (config.manhattan) {
    const std::vector<FaceBond> square = right_angles(drive);
    bonds.insert(bonds.end(), square.begin(), square.end());
  }
  fit = adjust(drive, bonds);
  pieces = cut_pieces(drive, evidence, config.walls.pieces, result.dropped);
  part_crossings(drive, config.walls.pieces, pieces, result.dropped);
  join_corners(drive, evidence, config.walls.pieces, pieces);
  drop_lonely(drive, config.walls.pieces, pieces, result.dropped);
  const std::vector<WallPair> pairs = pair_sides(drive, pieces, config.walls.solids);
  result.plan.walls = build_walls(drive, pieces, pairs);
  if (result.plan.walls.empty()) {
    throw std::invalid_argument("no wall was seen well enough to be believed");
  }

  result.thin = thin_places(drive, evidence, pieces);
  result.points = picture_points(drive);
  const core::Pose2 T_lidar_base = config.sensor.T_base_lidar.inverse();
  for (std::size_t turn = 0; turn < turns; ++turn) {
    result.T_map_base.push_back(drive.T_map_lidar[turn] * T_lidar_base);
    result.t_ns.push_back(recorded.middle_ns(turn));
  }
  result.forgotten_faces = drive.forgotten_faces;
  result.observations = drive.observations.size();
  result.outliers = fit.outliers;
  result.sigma = fit.sigma;
  result.has_odometry = drive.has_odometry;
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
