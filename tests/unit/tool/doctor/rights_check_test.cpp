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

class CheckRights : public testing::Test {
 protected:
  CheckRights() {
    stand_in_.plug_in();
    stand_in_.write("/etc/passwd", "root:x:0:0::/:/bin/sh\nada:x:1000:1000::/:/bin/sh\n");
    stand_in_.write("/etc/group", "root:x:0:\ndialout:x:20:\nuucp:x:10:\n");
  }
  Finding judge(gid_t gid, mode_t mode) const {
    FileFacts port;
    port.gid = gid;
    port.mode = mode;
    return check_port_rights(stand_in_.patient, port);
  }
  StandIn stand_in_;
};

TEST_F(CheckRights, CallerOutsideGroup_RemedyIsUsermod) {
  const Finding finding = judge(20, 0660);
  EXPECT_THAT(finding, Finds(Verdict::kWrong, "rights",
                             "ada must not open /dev/ttyUSB0 (crw-rw---- root dialout)"));
  EXPECT_THAT(finding.remedies,
              ElementsAre("sudo usermod -aG dialout ada, then log out and in again"));
}

TEST_F(CheckRights, SessionOlderThanMembership_RemedyIsNewLogin) {
  stand_in_.write("/etc/group", "dialout:x:20:ada\n");
  EXPECT_THAT(judge(20, 0660).remedies, ElementsAre(HasSubstr("this session began before")));
  stand_in_.patient.caller.gids.insert(20);
  EXPECT_THAT(judge(20, 0660), Finds(Verdict::kGood, "rights", "ada may open"));
}

TEST_F(CheckRights, ServiceUser_HasDialoutByItsUnit) {
  stand_in_.write("/etc/passwd", "cornerd:x:990:990::/:/bin/false\n");
  EXPECT_THAT(judge(20, 0660), Finds(Verdict::kGood, "rights", "the service's user cornerd may"));
  const Finding elsewhere = judge(10, 0660);
  EXPECT_THAT(elsewhere, Finds(Verdict::kWrong, "rights", "user cornerd must not"));
  EXPECT_THAT(elsewhere.remedies, ElementsAre(HasSubstr("usermod -aG uucp cornerd")));
}

TEST_F(CheckRights, PortOfRootOnly_RemedyIsUdevRules) {
  EXPECT_THAT(judge(0, 0600).remedies, ElementsAre(HasSubstr("udev rules")));
  EXPECT_THAT(judge(0, 0660).remedies, ElementsAre(HasSubstr("udev rules")));
}

TEST_F(CheckRights, AbsentPort_NoFinding) {
  EXPECT_EQ(check_rights(stand_in_.patient).size(), 1U);
  stand_in_.patient.config.lidar.device = "/dev/ttyUSB7";
  EXPECT_THAT(check_rights(stand_in_.patient), IsEmpty());
}

TEST_F(CheckRights, KindNotInDeviceAllow_RemedyIsDropIn) {
  stand_in_.write("/etc/passwd", "cornerd:x:990:990::/:/bin/false\n");
  stand_in_.write("/lib/systemd/system/cornerd.service",
                  "DevicePolicy=closed\nDeviceAllow=char-ttyUSB rw\n");
  EXPECT_EQ(check_rights(stand_in_.patient).size(), 1U);
  stand_in_.patient.config.lidar.device = "/dev/ttyXY3";
  stand_in_.write("/dev/ttyXY3");
  const auto found = check_rights(stand_in_.patient);
  ASSERT_EQ(found.size(), 2U);
  EXPECT_THAT(found[1], Finds(Verdict::kWrong, "rights", "DeviceAllow= has no ttyXY"));
  EXPECT_THAT(found[1].remedies, ElementsAre(HasSubstr("DeviceAllow=char-ttyXY rw"),
                                             HasSubstr("systemctl restart cornerd")));
}

}  // namespace
}  // namespace cornerd::tool
