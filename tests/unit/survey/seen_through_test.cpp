// SPDX-License-Identifier: MIT
#include "survey/seen_through.hpp"

#include <gtest/gtest.h>

#include "mapped_scene.hpp"

namespace cornerd::survey {
namespace {

/// A wall of 4 m of which each cell was hit by 100 rays, and so many went through a stretch of it.
SeenThrough through_stretch(double length_m, int passes) {
  const MappedFace face = face_between({2, 1}, {-2, 1});
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
  return seen_through(evidence, {piece});
}

TEST(SeenThrough, StretchThatRaysWentThrough_IsMeasured) {
  const SeenThrough through = through_stretch(1, 12);
  EXPECT_NEAR(through.length_m, 1, 0.03);
  EXPECT_EQ(through.places, 1U);
  EXPECT_NEAR(through.share(), 0.25, 0.01);
}

TEST(SeenThrough, FewRays_AreNoise) { EXPECT_EQ(through_stretch(1, 9).places, 0U); }

TEST(SeenThrough, ShortStretch_IsTheBlurOfAnEdge) {
  EXPECT_EQ(through_stretch(0.15, 12).places, 0U);
  EXPECT_EQ(through_stretch(0.15, 12).length_m, 0);
}

TEST(SeenThrough, WallThatNoRayWentThrough_IsNot) {
  EXPECT_EQ(through_stretch(0, 0).share(), 0);
  EXPECT_NEAR(through_stretch(0, 0).of_m, 4, 1e-9);
}

TEST(SeenThrough, NoWalls_HaveNoShare) { EXPECT_EQ(seen_through({}, {}).share(), 0); }

}  // namespace
}  // namespace cornerd::survey
