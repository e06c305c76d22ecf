// SPDX-License-Identifier: MIT
#include "survey/validity_checks.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <stdexcept>
#include <string>

namespace cornerd::survey {
namespace {

/// Distances between a face and its duplicate. Nearer ones may be one wall with range errors.
constexpr double kMinApart_m = 0.07;
constexpr double kMaxApart_m = 0.5;
constexpr double kMaxRotation_rad = core::radians(12);
/// A ray may pass the front face's end within this margin plus this multiple of the distance.
constexpr double kPastTheEnd = 2;
constexpr double kEnd_m = 0.1;

/// Length of `back` behind `front` where rays ended on both, metres.
double hidden_m(const MappedDrive& drive, const std::vector<FaceEvidence>& evidence,
                const WallPiece& front, const WallPiece& back) {
  const LineLandmark& before = drive.faces[front.face];
  const LineLandmark& behind = drive.faces[back.face];
  if (std::abs(core::angle_between(before.normal_rad(), behind.normal_rad())) > kMaxRotation_rad) {
    return 0;
  }
  const FaceEvidence& seen = evidence[back.face];
  std::size_t cells = 0;
  for (std::size_t cell = 0; cell < seen.size(); ++cell) {
    const double along_m = seen.along_of(cell) + FaceEvidence::kCell_m / 2;
    if (along_m < back.begin_m || along_m > back.end_m || !seen.is_wall(cell)) continue;
    const core::Vec2 place = behind.at(along_m);
    const double depth_m = -before.height_of(place);
    if (depth_m < kMinApart_m || depth_m > kMaxApart_m) continue;
    const double front_m = before.along_of(place);
    const double end_m = kEnd_m + kPastTheEnd * depth_m;
    if (front_m < front.begin_m + end_m || front_m > front.end_m - end_m) continue;
    if (evidence[front.face].hits_at(front_m) > 0) ++cells;
  }
  return FaceEvidence::kCell_m * static_cast<double>(cells);
}

/// Fewer rays are outliers, or of few scans.
constexpr std::uint32_t kMinPasses = 10;
/// Share of the rays that ended there.
constexpr double kMinPassShare = 0.05;
/// Cells in a row.
constexpr std::size_t kMinCells = 10;

bool is_conflict(const FaceEvidence& seen, std::size_t cell) {
  return seen.passes(cell) >= kMinPasses &&
         seen.passes(cell) > kMinPassShare * static_cast<double>(seen.hits(cell));
}

/// Share of all scans that may be extrapolated.
constexpr double kMaxUnmatchedShare = 0.02;
/// Share of the length of all walls. Correct maps: up to 0.002 in simulation, 0.009 among chair
/// legs. Wrong maps: from 0.014 on.
constexpr double kMaxDuplicateShare = 0.012;
constexpr double kMinDuplicate_m = 0.5;
/// Share of all wall faces. Correct maps: 0 in simulation, 0.02 to 0.033 of a house driven through
/// on slipping tracks. Wrong maps: from 0.023 on; from 0.07 on where the robot was carried.
constexpr double kWarnShare = 0.004;
constexpr double kMaxShare = 0.06;
constexpr double kMinConflict_m = 0.6;

bool are_few(std::span<const std::size_t> scans, const RecordedDrive& recorded) {
  return static_cast<double>(scans.size()) <=
         kMaxUnmatchedShare * static_cast<double>(recorded.size());
}

std::string one_decimal(double value) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.1f", value);
  return text.data();
}

[[noreturn]] void fail(const RecordedDrive& recorded, std::span<const std::size_t> scans,
                       const std::string& what, const std::string& advice) {
  const double first_s = core::to_seconds(recorded.start_ns(scans.front()) - recorded.start_ns(0));
  throw std::invalid_argument("without odometry, " + std::to_string(scans.size()) + " of " +
                              std::to_string(recorded.size()) + " scans " + what + ", the first " +
                              std::to_string(std::llround(first_s)) +
                              " s after the start: " + advice);
}

}  // namespace

double duplicate_walls_m(const MappedDrive& drive, const std::vector<FaceEvidence>& evidence,
                         const std::vector<WallPiece>& pieces) {
  double duplicate_m = 0;
  for (const WallPiece& back : pieces) {
    double most_m = 0;
    for (const WallPiece& front : pieces) {
      if (front.face != back.face)
        most_m = std::max(most_m, hidden_m(drive, evidence, front, back));
    }
    duplicate_m += most_m;
  }
  return duplicate_m;
}

FreeSpaceConflicts free_space_conflicts(const std::vector<FaceEvidence>& evidence,
                                        const std::vector<WallPiece>& pieces) {
  FreeSpaceConflicts sum;
  for (const WallPiece& piece : pieces) {
    const FaceEvidence& seen = evidence[piece.face];
    sum.of_m += piece.length_m();
    std::size_t run = 0;
    const auto close = [&] {
      if (run >= kMinCells) {
        sum.length_m += FaceEvidence::kCell_m * static_cast<double>(run);
        ++sum.places;
      }
      run = 0;
    };
    for (std::size_t cell = 0; cell < seen.size(); ++cell) {
      const double middle_m = seen.along_of(cell) + FaceEvidence::kCell_m / 2;
      if (middle_m < piece.begin_m || middle_m > piece.end_m) continue;
      if (is_conflict(seen, cell)) {
        ++run;
      } else {
        close();
      }
    }
    close();
  }
  return sum;
}

void check_scan_count(const RecordedDrive& recorded, std::size_t needed) {
  if (recorded.size() >= needed) return;
  if (recorded.size() == 0) {
    throw std::invalid_argument("the recording has no complete scan: record for longer");
  }
  throw std::invalid_argument("the recording has " + std::to_string(recorded.size()) +
                              " complete scans, and a wall needs " + std::to_string(needed) +
                              ": record for longer");
}

void check_overlap(const RecordedDrive& recorded, const MappedDrive& drive) {
  if (drive.has_odometry || are_few(drive.unmatched_scans, recorded)) return;
  fail(recorded, drive.unmatched_scans, "overlap too little with those before them",
       "drive more slowly there, or record the odometry too");
}

void check_pauses(const RecordedDrive& recorded, const MappedDrive& drive) {
  if (drive.displaced_scans.empty()) return;
  const std::size_t scan = drive.displaced_scans.front();
  const auto after_start = [&](core::TimeNs t_ns) {
    return one_decimal(core::to_seconds(t_ns - recorded.start_ns(0)));
  };
  throw std::invalid_argument(
      "no scan and no odometry from " + after_start(recorded.end_ns(scan - 1)) + " to " +
      after_start(recorded.start_ns(scan)) +
      " s after the start, and the scan after it shows another place: survey the parts one by one, "
      "or record again");
}

void check_degenerate_scans(const RecordedDrive& recorded, std::span<const std::size_t> degenerate,
                            std::span<const LoopReport> loops) {
  if (are_few(degenerate, recorded)) return;
  for (const LoopReport& loop : loops) {
    const auto inside = std::upper_bound(degenerate.begin(), degenerate.end(), loop.earlier);
    if (loop.closed() && inside != degenerate.end() && *inside < loop.later) return;
  }
  fail(recorded, degenerate,
       "show only walls along one direction, and no loop closure determines the distance along "
       "them",
       "record the odometry too");
}

bool has_duplicate_walls(double duplicate_m, std::span<const core::Wall> walls) {
  double all_m = 0;
  for (const core::Wall& wall : walls) all_m += (wall.to - wall.from).norm();
  return duplicate_m > std::max(kMinDuplicate_m, kMaxDuplicateShare * all_m);
}

void check_duplicate_walls(double duplicate_m, std::span<const core::Wall> walls) {
  if (!has_duplicate_walls(duplicate_m, walls)) return;
  throw std::invalid_argument("without odometry, " + one_decimal(duplicate_m) +
                              " m of walls are mapped twice, one behind the other, since the scans "
                              "overlap too little: drive more slowly, or record the odometry too");
}

bool has_free_space_conflicts(const FreeSpaceConflicts& conflicts) {
  return conflicts.share() > kWarnShare;
}

void check_free_space_conflicts(const FreeSpaceConflicts& conflicts) {
  // One place is a door or a cupboard that moved.
  if (conflicts.places < 2 || conflicts.length_m < kMinConflict_m ||
      conflicts.share() < kMaxShare) {
    return;
  }
  std::array<char, 128> text{};
  std::snprintf(text.data(), text.size(),
                "rays went through %.1f of %.1f m of the wall faces (%.1f %%)", conflicts.length_m,
                conflicts.of_m, 100 * conflicts.share());
  throw std::invalid_argument(
      std::string(text.data()) +
      ": the recording maps several places over each other. Record again in one go, without "
      "carrying the robot or moving doors and furniture, and begin each further recording where "
      "the one before ended; or measure lidar.noise, if the lidar is much worse than that says");
}

}  // namespace cornerd::survey
