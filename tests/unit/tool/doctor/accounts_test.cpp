// SPDX-License-Identifier: MIT
#include "tool/doctor/accounts.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "doctor/stand_in.hpp"

namespace cornerd::tool {
namespace {

using testing::ElementsAre;

class Accounts : public testing::Test {
 protected:
  Accounts() {
    stand_in_.write("/etc/passwd",
                    "root:x:0:0::/root:/bin/sh\nbroken\nada:x:1000:1000:Ada:/home/ada:/bin/sh\n");
    stand_in_.write("/etc/group",
                    "dialout:x:20:bob,ada\nvideo:*:44:\nempty:x:x:ada\nada:x:1000:\n");
  }
  const Machine& machine() const { return stand_in_.patient.machine; }
  StandIn stand_in_;
};

TEST_F(Accounts, KnownUser_HasItsGroups) {
  const auto ada = find_account(machine(), "ada");
  ASSERT_TRUE(ada);
  EXPECT_EQ(ada->uid, 1000U);
  EXPECT_THAT(ada->gids, ElementsAre(20U, 1000U));
  EXPECT_EQ(find_account(machine(), uid_t{1000})->name, "ada");
  EXPECT_FALSE(find_account(machine(), "eve"));
}

TEST_F(Accounts, KnownGroup_HasItsName) {
  EXPECT_EQ(group_name(machine(), 44), "video");
  EXPECT_EQ(group_name(machine(), 99), "99");
  EXPECT_EQ(find_group(machine(), "dialout"), 20U);
  EXPECT_FALSE(find_group(machine(), "empty"));
}

TEST(MayReadAndWrite, OwnerGroupOrOthers_FirstMatchDecides) {
  const Account ada{"ada", 1000, {1000, 20}};
  const auto file = [](uid_t uid, gid_t gid, mode_t mode) {
    FileFacts facts;
    facts.uid = uid;
    facts.gid = gid;
    facts.mode = mode;
    return facts;
  };
  EXPECT_TRUE(may_read_and_write(ada, file(0, 20, 0660)));
  EXPECT_FALSE(may_read_and_write(ada, file(0, 20, 0640)));
  EXPECT_FALSE(may_read_and_write(ada, file(0, 20, 0606)));
  EXPECT_FALSE(may_read_and_write(ada, file(0, 5, 0660)));
  EXPECT_TRUE(may_read_and_write(ada, file(0, 5, 0666)));
  EXPECT_TRUE(may_read_and_write(ada, file(1000, 5, 0600)));
  EXPECT_TRUE(may_read_and_write({"root", 0, {0}}, file(5, 5, 0)));
}

TEST(MayAccess, PartOfRights_IsDenied) {
  const Account ada{"ada", 1000, {1000}};
  FileFacts folder;
  folder.mode = 0751;
  EXPECT_TRUE(may_access(ada, folder, 01));
  EXPECT_FALSE(may_access(ada, folder, 04));
  EXPECT_FALSE(may_access(ada, folder, 05));
}

}  // namespace
}  // namespace cornerd::tool
