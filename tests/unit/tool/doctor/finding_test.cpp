// SPDX-License-Identifier: MIT
#include "tool/doctor/finding.hpp"

#include <gtest/gtest.h>

namespace cornerd::tool {
namespace {

TEST(Finding, Text_HasALineForEachAndForEachMend) {
  const Finding findings[] = {{Verdict::kGood, "port", "/dev/x"},
                              {Verdict::kWrong, "holder", "somebody", {"end it", "or wait"}},
                              {Verdict::kNote, "power", "hm"}};
  EXPECT_EQ(findings_text(findings),
            "ok     port      /dev/x\n"
            "WRONG  holder    somebody\n"
            "                 -> end it\n"
            "                 -> or wait\n"
            "note   power     hm\n");
  EXPECT_EQ(count_wrong(findings), 1U);
}

}  // namespace
}  // namespace cornerd::tool
