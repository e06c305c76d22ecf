// SPDX-License-Identifier: MIT
#include "core/scan.hpp"

#include <gtest/gtest.h>

#include "core/geometry/angle.hpp"

namespace cornerd::core {
namespace {

Sample sample_at(double bearing_rad, bool starts_turn = false) {
  Sample sample;
  sample.bearing_rad = static_cast<float>(normalize_angle(bearing_rad));
  sample.range_m = 1;
  sample.starts_turn = starts_turn;
  return sample;
}

TEST(TurnAssembler, StreamJoinedInMidTurn_GivesOnlyWholeTurns) {
  TurnAssembler assembler;
  Scan turn;
  int turns = 0;
  for (int i = 37; i < 500; ++i) {
    if (!assembler.add(sample_at(-kTwoPi * i / 100, i % 100 == 0), turn)) continue;
    ++turns;
    EXPECT_EQ(turn.size(), 100U);
    EXPECT_TRUE(turn.samples().front().starts_turn);
  }
  EXPECT_EQ(turns, 3);
  EXPECT_EQ(assembler.dropped(), 63U);
}

TEST(TurnAssembler, Finish_HandsOutATurnThatWentRound) {
  TurnAssembler assembler;
  Scan turn;
  for (int i = 0; i < 99; ++i) assembler.add(sample_at(-kTwoPi * i / 100, i == 0), turn);
  EXPECT_TRUE(assembler.finish(turn));
  EXPECT_EQ(turn.size(), 99U);
  EXPECT_FALSE(assembler.finish(turn));
}

TEST(TurnAssembler, Finish_KeepsBackAPieceOfATurn) {
  TurnAssembler assembler;
  Scan turn;
  for (int i = 0; i < 60; ++i) assembler.add(sample_at(-kTwoPi * i / 100, i == 0), turn);
  EXPECT_FALSE(assembler.finish(turn));
  EXPECT_EQ(assembler.dropped(), 60U);
}

TEST(TurnAssembler, SampleThatEndsTheTurn_CompletesItAtOnce) {
  TurnAssembler assembler;
  Scan turn;
  EXPECT_FALSE(assembler.add(sample_at(0, true), turn));
  EXPECT_FALSE(assembler.add(sample_at(1), turn));
  Sample last = sample_at(2);
  last.ends_turn = true;
  EXPECT_TRUE(assembler.add(last, turn));
  EXPECT_EQ(turn.size(), 3U);
  EXPECT_FALSE(assembler.add(sample_at(0, true), turn)) << "nothing was collected in between";
}

TEST(TurnAssembler, EndlessTurn_IsCutAtTheCapacityAndCounted) {
  TurnAssembler assembler;
  Scan turn;
  assembler.add(sample_at(0, true), turn);
  for (std::size_t i = 1; i < kMaxSamplesPerTurn + 100; ++i) assembler.add(sample_at(0.1), turn);
  EXPECT_EQ(assembler.dropped(), 100U);
  ASSERT_TRUE(assembler.add(sample_at(0, true), turn));
  EXPECT_EQ(turn.size(), kMaxSamplesPerTurn);
}

TEST(TurnAssembler, Reset_ForgetsTheTurnInProgress) {
  TurnAssembler assembler;
  Scan turn;
  for (int i = 0; i < 99; ++i) assembler.add(sample_at(-kTwoPi * i / 100, i == 0), turn);
  assembler.reset();
  EXPECT_FALSE(assembler.add(sample_at(0, true), turn));
}

}  // namespace
}  // namespace cornerd::core
