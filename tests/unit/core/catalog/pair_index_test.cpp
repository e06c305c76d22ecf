// SPDX-License-Identifier: MIT
#include "core/catalog/pair_index.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <set>
#include <utility>

namespace cornerd::core {
namespace {

class PairIndexTest : public ::testing::Test {
 protected:
  PairIndexTest() {
    for (int i = 0; i < 40; ++i) {
      Corner corner;
      corner.position = {uniform(0, 8), uniform(0, 8)};
      corner.left_face_rad = uniform(-kPi, kPi);
      corner.opening_rad = i % 3 == 0 ? kPi / 2 : 3 * kPi / 2;
      corner.right_face_rad = normalize_angle(corner.left_face_rad + corner.opening_rad);
      landmarks_.push_back(corner);
    }
    for (std::uint32_t i = 0; i < landmarks_.size(); ++i) {
      for (std::uint32_t j = i + 1; j < landmarks_.size(); ++j) {
        const double distance_m = (landmarks_[i].position - landmarks_[j].position).norm();
        pairs_.push_back({i, j, static_cast<float>(distance_m)});
      }
    }
  }
  double uniform(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random_);
  }
  /// Tests a pair against the query without an index; `slack_rad` widens its tolerance on both
  /// sides.
  bool answers(const PairQuery& query, std::uint32_t from, std::uint32_t to, double slack_rad) {
    const Corner& corner = landmarks_[from];
    const Vec2 way = landmarks_[to].position - corner.position;
    const auto distance_m = static_cast<double>(static_cast<float>(way.norm()));
    const double wall_rad =
        query.side == FaceSide::kLeft ? corner.left_face_rad : corner.right_face_rad;
    const double off_rad =
        angle_between(query.wall_rad, angle_between(std::atan2(way.y(), way.x()), wall_rad));
    return corner.is_convex() == query.convex && distance_m >= query.low_m &&
           distance_m <= query.high_m && std::abs(off_rad) <= query.tolerance_rad + slack_rad;
  }

  std::mt19937_64 random_{3};
  std::vector<Corner> landmarks_;
  std::vector<LandmarkPair> pairs_;
};

TEST_F(PairIndexTest, Query_AllMatchesWithFewOthers) {
  const PairIndex index(landmarks_, pairs_);
  EXPECT_EQ(index.size(), pairs_.size());
  std::size_t found = 0;
  for (int k = 0; k < 400; ++k) {
    PairQuery query;
    query.low_m = uniform(-1, 11);
    query.high_m = query.low_m + uniform(0, 0.5);
    query.convex = k % 2 == 0;
    query.side = k % 4 < 2 ? FaceSide::kLeft : FaceSide::kRight;
    query.wall_rad = uniform(-kPi, kPi);
    query.tolerance_rad = k % 10 == 0 ? kPi : radians(15);
    std::set<std::pair<std::uint32_t, std::uint32_t>> answers_given;
    std::size_t visited = 0;
    index.visit(query, [&](const LandmarkPair& pair) {
      ++visited;
      answers_given.emplace(pair.from, pair.to);
      EXPECT_TRUE(answers(query, pair.from, pair.to, kTwoPi / PairIndex::kDirections));
    });
    EXPECT_EQ(visited, answers_given.size()) << "each once";
    EXPECT_LE(visited, index.cost(query));
    found += visited;
    for (const LandmarkPair& pair : pairs_) {
      for (const auto& [from, to] : {std::pair{pair.from, pair.to}, {pair.to, pair.from}}) {
        EXPECT_TRUE(!answers(query, from, to, -1e-9) || answers_given.contains({from, to}));
      }
    }
  }
  EXPECT_GT(found, 1000U);
}

TEST_F(PairIndexTest, NoPairs_NothingFound) {
  for (const PairIndex& index : {PairIndex(), PairIndex(landmarks_, {})}) {
    EXPECT_EQ(index.size(), 0U);
    index.visit({0, 10, true, FaceSide::kLeft, 0, kPi},
                [](const LandmarkPair&) { ADD_FAILURE() << "there is none"; });
  }
}

}  // namespace
}  // namespace cornerd::core
