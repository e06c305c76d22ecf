// SPDX-License-Identifier: MIT
#include "bench/instruction_counter.hpp"

#include <gtest/gtest.h>

namespace cornerd::bench {
namespace {

TEST(CallgrindReport, ReportWithCount_ReturnsCount) {
  EXPECT_EQ(parse_callgrind_report("==7== Events    : Ir\n==7== Collected : 3325337\n==7== \n"),
            3'325'337u);
}

TEST(CallgrindReport, ReportWithoutCount_ReturnsNothing) {
  EXPECT_FALSE(parse_callgrind_report(""));
  EXPECT_FALSE(parse_callgrind_report("==7== Collected : "));
  EXPECT_FALSE(parse_callgrind_report("==7== Collected : many"));
}

}  // namespace
}  // namespace cornerd::bench
