// SPDX-License-Identifier: MIT
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "doctor/stand_in.hpp"
#include "tool/doctor/checks.hpp"

namespace cornerd::tool {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

TEST(CheckControl, OutsideTheGroup_OnlyReads) {
  StandIn stand_in;
  EXPECT_THAT(check_control(stand_in.patient), IsEmpty());
  stand_in.write("/etc/passwd", "ada:x:1000:1000::/:/bin/sh\n");
  stand_in.write("/etc/group", "cornerd:x:990:\n");
  const auto found = check_control(stand_in.patient);
  ASSERT_THAT(found, ElementsAre(Finds(Verdict::kNote, "control", "send no requests")));
  EXPECT_THAT(found[0].mends, ElementsAre(HasSubstr("usermod -aG cornerd ada")));
  stand_in.write("/etc/group", "cornerd:x:990:ada\n");
  EXPECT_THAT(check_control(stand_in.patient),
              ElementsAre(Finds(Verdict::kNote, "control", "older")));
  stand_in.patient.caller.gids.insert(990);
  EXPECT_THAT(check_control(stand_in.patient),
              ElementsAre(Finds(Verdict::kGood, "control", "may send requests")));
  stand_in.patient.caller = {"root", 0, {0}};
  EXPECT_THAT(check_control(stand_in.patient), IsEmpty());
}

}  // namespace
}  // namespace cornerd::tool
