// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <array>
#include <utility>

#include "drivers/rplidar/wire/ultra_capsule.hpp"

namespace cornerd::rplidar {
namespace {

TEST(Varbit, AllRanges_MatchTheSdksTable) {
  constexpr std::array<std::pair<int, int>, 12> kTable{{{511, 511},
                                                        {512, 512},
                                                        {513, 514},
                                                        {1279, 2046},
                                                        {1280, 2048},
                                                        {1281, 2052},
                                                        {1791, 4092},
                                                        {1792, 4096},
                                                        {1793, 4104},
                                                        {3327, 16376},
                                                        {3328, 16384},
                                                        {4095, 28656}}};
  for (const auto& [code, mm] : kTable) EXPECT_EQ(decode_varbit(code).mm, mm) << code;
}

TEST(Varbit, Level_IsTheStepOfItsRange) {
  for (const int code : {0, 100, 600, 1300, 2000, 4000}) {
    EXPECT_EQ(decode_varbit(code + 1).mm - decode_varbit(code).mm, 1 << decode_varbit(code).level)
        << code;
  }
}

}  // namespace
}  // namespace cornerd::rplidar
