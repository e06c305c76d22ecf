// SPDX-License-Identifier: MIT
#include "survey/validity_checks.hpp"

#include <gtest/gtest.h>

#include <stdexcept>
#include <string>

#include "mapped_scene.hpp"

namespace cornerd::survey {
namespace {

using core::Vec2;

RecordedDrive drive_of(std::size_t scans) {
  RecordedDrive drive;
  for (std::size_t i = 0; i < scans; ++i) {
    core::Scan scan;
    core::Sample sample;
    sample.t_ns = static_cast<core::TimeNs>(i) * 1'000'000'000;
    scan.add(sample);
    drive.add(scan);
  }
  return drive;
}

template <typename Check>
std::string refusal(const Check& check) {
  try {
    check();
  } catch (const std::invalid_argument& refused) {
    return refused.what();
  }
  return {};
}

TEST(CheckScanCount, FewerScansThanNeeded_FailsWithTheirNumber) {
  EXPECT_EQ(refusal([] { check_scan_count(drive_of(4), 5); }),
            "the recording has 4 complete scans, and a wall needs 5: record for longer");
  EXPECT_EQ(refusal([] { check_scan_count(drive_of(5), 5); }), "");
  EXPECT_EQ(refusal([] { check_scan_count({}, 5); }),
            "the recording has no complete scan: record for longer");
}

TEST(CheckOverlap, MoreThanTwoPercentUnmatched_FailsWithTimeOfFirst) {
  MappedDrive drive;
  drive.unmatched_scans = {20, 21};
  EXPECT_EQ(refusal([&] { check_overlap(drive_of(100), drive); }), "");
  drive.unmatched_scans.push_back(22);
  EXPECT_EQ(refusal([&] { check_overlap(drive_of(100), drive); }),
            "without odometry, 3 of 100 scans overlap too little with those before them, the first "
            "20 s after the start: drive more slowly there, or record the odometry too");
  drive.has_odometry = true;
  EXPECT_EQ(refusal([&] { check_overlap(drive_of(100), drive); }), "");
}

TEST(CheckDegenerateScans, ClosedLoopAcrossThem_Passes) {
  const std::vector<std::size_t> degenerate = {40, 41, 42};
  LoopReport loop;
  loop.earlier = 10;
  loop.later = 41;
  const auto with = [&](const LoopReport& report) {
    return refusal([&] { check_degenerate_scans(drive_of(100), degenerate, {&report, 1}); });
  };
  EXPECT_EQ(with(loop), "");
  loop.refused = "for a reason";
  EXPECT_NE(with(loop).find("3 of 100 scans show only walls along one direction"),
            std::string::npos);
  loop.refused.clear();
  loop.later = 40;
  EXPECT_NE(with(loop), "");
}

TEST(CheckDuplicateWalls, MoreThanLimit_FailsWithLength) {
  const std::vector<core::Wall> small = {{{0, 0}, {10, 0}, 0}};
  const std::vector<core::Wall> large = {{{0, 0}, {100, 0}, 0}};
  EXPECT_EQ(refusal([&] { check_duplicate_walls(0.49, small); }), "");
  EXPECT_EQ(refusal([&] { check_duplicate_walls(1.19, large); }), "");
  EXPECT_NE(refusal([&] { check_duplicate_walls(0.51, small); }).find("0.5 m of walls"),
            std::string::npos);
  EXPECT_NE(refusal([&] { check_duplicate_walls(1.21, large); }).find("overlap too little"),
            std::string::npos);
}

TEST(CheckFreeSpaceConflicts, MoreThanLimit_FailsWithShare) {
  const auto with = [](double length_m, std::size_t places, double of_m) {
    return refusal([&] { check_free_space_conflicts({length_m, places, of_m}); });
  };
  EXPECT_EQ(with(5.9, 2, 100), "");
  EXPECT_NE(with(6.1, 2, 100).find("went through 6.1 of 100.0 m of the wall faces (6.1 %)"),
            std::string::npos);
  EXPECT_EQ(with(6.1, 1, 100), "");
  EXPECT_EQ(with(0.5, 2, 10), "");
  EXPECT_EQ(with(0, 0, 0), "");
}

TEST(HasFreeSpaceConflicts, MoreThanPoseNoise_IsTrue) {
  EXPECT_FALSE(has_free_space_conflicts({0.3, 1, 100}));
  EXPECT_TRUE(has_free_space_conflicts({0.5, 1, 100}));
}

/// Duplicate length among walls with hits everywhere; faces look to the origin.
double duplicate_m(const std::vector<std::pair<Vec2, Vec2>>& walls) {
  MappedDrive drive;
  std::vector<FaceEvidence> evidence;
  std::vector<WallPiece> pieces;
  for (const auto& [from, to] : walls) {
    const LineLandmark face = face_between(from, to);
    FaceEvidence seen(face);
    for (double along_m = face.begin_m(); along_m < face.end_m(); along_m += 0.001) {
      seen.add_hit(along_m);
    }
    WallPiece piece;
    piece.face = static_cast<std::uint32_t>(drive.faces.size());
    piece.begin_m = face.begin_m();
    piece.end_m = face.end_m();
    drive.faces.push_back(face);
    evidence.push_back(seen);
    pieces.push_back(piece);
  }
  return duplicate_walls_m(drive, evidence, pieces);
}

TEST(DuplicateWalls, WallBehindAnother_CountsWithoutItsEnds) {
  EXPECT_NEAR(duplicate_m({{{2, 1}, {-2, 1}}, {{2, 1.1}, {-2, 1.1}}}), 4 - 2 * 0.3, 0.05);
}

TEST(DuplicateWalls, WallRotatedByFewDegrees_CountsWhereBehind) {
  EXPECT_GT(duplicate_m({{{2, 1}, {-2, 1}}, {{2, 1.3}, {-2, 0.9}}}), 1);
}

TEST(DuplicateWalls, WallBesideAnother_CountsNothing) {
  EXPECT_EQ(duplicate_m({{{2, 1}, {0.5, 1}}, {{0.5, 1.1}, {-2, 1.1}}}), 0);
}

TEST(DuplicateWalls, WallWithinRangeError_CountsNothing) {
  EXPECT_EQ(duplicate_m({{{2, 1}, {-2, 1}}, {{2, 1.04}, {-2, 1.04}}}), 0);
}

TEST(DuplicateWalls, NextRoom_CountsNothing) {
  EXPECT_EQ(duplicate_m({{{2, 1}, {-2, 1}}, {{2, 2}, {-2, 2}}}), 0);
}

TEST(DuplicateWalls, OppositeFace_CountsNothing) {
  EXPECT_EQ(duplicate_m({{{2, 1}, {-2, 1}}, {{-2, 1.1}, {2, 1.1}}}), 0);
}

/// A wall of 4 m with 100 hits in each cell, and `passes` in each cell of a part of it.
FreeSpaceConflicts conflicts_of_part(double length_m, int passes) {
  const LineLandmark face = face_between({2, 1}, {-2, 1});
  std::vector<FaceEvidence> evidence(1, FaceEvidence(face));
  FaceEvidence& seen = evidence.front();
  for (std::size_t cell = 0; cell < seen.size(); ++cell) {
    const double middle_m = seen.along_of(cell) + FaceEvidence::kCell_m / 2;
    if (middle_m < face.begin_m() || middle_m > face.end_m()) continue;
    for (int i = 0; i < 100; ++i) seen.add_hit(middle_m);
    const double from_m = middle_m - face.begin_m() - 1;
    for (int i = 0; i < passes && from_m > 0 && from_m < length_m; ++i) seen.add_pass(middle_m);
  }
  WallPiece piece;
  piece.begin_m = face.begin_m();
  piece.end_m = face.end_m();
  return free_space_conflicts(evidence, {piece});
}

TEST(FreeSpaceConflicts, PassesOverOneMetre_AreMeasured) {
  const FreeSpaceConflicts free_space_conflicts = conflicts_of_part(1, 12);
  EXPECT_NEAR(free_space_conflicts.length_m, 1, 0.03);
  EXPECT_EQ(free_space_conflicts.places, 1U);
  EXPECT_NEAR(free_space_conflicts.share(), 0.25, 0.01);
}

TEST(FreeSpaceConflicts, FewPasses_CountNothing) { EXPECT_EQ(conflicts_of_part(1, 9).places, 0U); }

TEST(FreeSpaceConflicts, ShortPart_CountsNothing) {
  EXPECT_EQ(conflicts_of_part(0.15, 12).places, 0U);
  EXPECT_EQ(conflicts_of_part(0.15, 12).length_m, 0);
}

TEST(FreeSpaceConflicts, NoPasses_HaveShareZero) {
  EXPECT_EQ(conflicts_of_part(0, 0).share(), 0);
  EXPECT_NEAR(conflicts_of_part(0, 0).of_m, 4, 1e-9);
}

TEST(FreeSpaceConflicts, NoWalls_HaveShareZero) {
  EXPECT_EQ(free_space_conflicts({}, {}).share(), 0);
}

}  // namespace
}  // namespace cornerd::survey
