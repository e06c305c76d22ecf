// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <vector>

#include "replay/simulator/serial_line.hpp"

namespace cornerd::replay {
namespace {

TEST(ByteFaults, ProbabilityZero_LeavesEveryByte) {
  ByteFaults faults(0, 1);
  const std::vector<std::uint8_t> sent(1000, 0xA5);
  const auto arrived = faults.pass(sent);
  EXPECT_TRUE(std::equal(arrived.begin(), arrived.end(), sent.begin(), sent.end()));
  EXPECT_EQ(faults.faults(), 0u);
}

TEST(ByteFaults, ProbabilityOnePercent_LosesOrDamagesThatShare) {
  ByteFaults faults(0.01, 1);
  const std::vector<std::uint8_t> sent(1'000'000, 0xA5);
  const auto arrived = faults.pass(sent);
  EXPECT_NEAR(static_cast<double>(faults.faults()), 10'000, 500);
  const std::size_t lost = sent.size() - arrived.size();
  EXPECT_NEAR(static_cast<double>(lost), 3'333, 300);
  std::size_t damaged = 0;
  for (const std::uint8_t byte : arrived) damaged += byte != 0xA5;
  EXPECT_EQ(lost + damaged, faults.faults());
}

TEST(ByteFaults, AnyPortions_GiveTheSameResult) {
  std::vector<std::uint8_t> sent(5000);
  for (std::size_t i = 0; i < sent.size(); ++i) sent[i] = static_cast<std::uint8_t>(i);
  ByteFaults whole(0.05, 4);
  const auto expected = whole.pass(sent);
  ByteFaults cut(0.05, 4);
  std::vector<std::uint8_t> arrived;
  for (std::size_t i = 0; i < sent.size(); i += 100) {
    const auto part = cut.pass(std::span(sent).subspan(i, 100));
    arrived.insert(arrived.end(), part.begin(), part.end());
  }
  EXPECT_TRUE(std::equal(arrived.begin(), arrived.end(), expected.begin(), expected.end()));
}

}  // namespace
}  // namespace cornerd::replay
