// SPDX-License-Identifier: MIT
#include "tool/doctor/finding.hpp"

#include <gtest/gtest.h>

namespace cornerd::tool {
namespace {

TEST(Finding, Text_HasALineForEachFindingAndRemedy) {
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

TEST(Finding, GoodFindingOfWrongSubject_IsDropped) {
  std::vector<Finding> findings = {{Verdict::kGood, "config", "a"},
                                   {Verdict::kGood, "map", "b"},
                                   {Verdict::kNote, "map", "c"},
                                   {Verdict::kWrong, "map", "d"}};
  drop_overruled(findings);
  EXPECT_EQ(findings_text(findings),
            "ok     config    a\nnote   map       c\nWRONG  map       d\n");
}

}  // namespace
}  // namespace cornerd::tool
