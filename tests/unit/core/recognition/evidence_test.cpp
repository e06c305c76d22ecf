// SPDX-License-Identifier: MIT
#include "core/recognition/evidence.hpp"

#include <gtest/gtest.h>

#include "core/geometry/angle.hpp"

namespace cornerd::core {
namespace {

BeamLikelihood hits_of_800(std::size_t hits) {
  BeamLikelihood likelihood;
  likelihood.rays = 800;
  likelihood.hits = hits;
  likelihood.shorts = 800 - hits;
  return likelihood;
}

TEST(Evidence, NearlyAllHits_IsConclusive) {
  EXPECT_TRUE(is_conclusive(hits_of_800(780), false));
  EXPECT_FALSE(is_conclusive(hits_of_800(770), false));
  EXPECT_TRUE(is_conclusive(hits_of_800(770), true));
}

TEST(Evidence, AFewOutliersMore_IsExact) {
  EXPECT_TRUE(is_exact(hits_of_800(765), false));
  EXPECT_FALSE(is_exact(hits_of_800(755), false));
  EXPECT_TRUE(is_exact(hits_of_800(755), true));
}

TEST(Evidence, FewRays_AreNotConclusive) {
  BeamLikelihood few;
  few.rays = few.hits = 99;
  EXPECT_FALSE(is_conclusive(few, true));
}

TEST(Evidence, HalfTheView_IsNoFullCoverage) {
  EXPECT_TRUE(has_full_coverage(radians(120)));
  EXPECT_FALSE(has_full_coverage(radians(180)));
}

}  // namespace
}  // namespace cornerd::core
