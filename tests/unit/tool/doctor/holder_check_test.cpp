// SPDX-License-Identifier: MIT
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdio>
#include <string>

#include "doctor/stand_in.hpp"
#include "tool/doctor/checks.hpp"
#include "tool/doctor/process_table.hpp"

namespace cornerd::tool {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

class CheckHolders : public testing::Test {
 protected:
  CheckHolders() { stand_in_.plug_in(); }

  void open_port(int pid, const std::string& name) const {
    stand_in_.run_process(pid, name);
    stand_in_.link("/proc/" + std::to_string(pid) + "/fd/0", "/dev/null");
    stand_in_.link("/proc/" + std::to_string(pid) + "/fd/7", "/dev/ttyUSB0");
  }
  /// A line of /proc/locks about the port.
  std::string lock_by(int pid) const {
    const FileFacts port = *stand_in_.patient.machine.facts("/dev/ttyUSB0");
    char line[120];
    std::snprintf(line, sizeof line, "3: FLOCK  ADVISORY  WRITE %d %02x:%02x:%lu 0 EOF\n", pid,
                  port.device_major, port.device_minor, static_cast<unsigned long>(port.inode));
    return line;
  }
  std::vector<Finding> findings() const { return check_holders(stand_in_.patient); }
  StandIn stand_in_;
};

TEST_F(CheckHolders, FreePort_IsGood) {
  stand_in_.run_process(1, "init");
  stand_in_.link("/proc/1/fd/0", "/dev/null");
  EXPECT_THAT(findings(), ElementsAre(Finds(Verdict::kGood, "holder", "nobody has")));
}

TEST_F(CheckHolders, HeldByCornerd_IsGood) {
  open_port(77, "cornerd");
  EXPECT_THAT(findings(), ElementsAre(Finds(Verdict::kGood, "holder", "cornerd (process 77)")));
}

TEST_F(CheckHolders, HeldByOthers_HasRemedies) {
  open_port(77, "cornerd");
  open_port(80, "gpsd");
  open_port(81, "ModemManager");
  open_port(82, "agetty");
  open_port(83, "minicom");
  const auto found = findings();
  ASSERT_THAT(found, ElementsAre(Finds(Verdict::kWrong, "holder", "gpsd (process 80)"),
                                 Finds(Verdict::kWrong, "holder", "ModemManager (process 81)"),
                                 Finds(Verdict::kWrong, "holder", "agetty"),
                                 Finds(Verdict::kWrong, "holder", "minicom")));
  EXPECT_THAT(found[0].remedies[0], HasSubstr("gpsd.socket"));
  EXPECT_THAT(found[1].remedies[0], HasSubstr("mask --now ModemManager"));
  EXPECT_THAT(found[2].remedies[0], HasSubstr("serial-getty@ttyUSB0.service"));
  EXPECT_THAT(found[3].remedies[0], HasSubstr("sudo kill 83"));
}

TEST_F(CheckHolders, CallerItself_IsIgnored) {
  open_port(84, "cornerctl");
  stand_in_.link("/proc/self", "84");
  EXPECT_THAT(findings(), ElementsAre(Finds(Verdict::kGood, "holder", "nobody has")));
}

TEST_F(CheckHolders, HolderWithHiddenFiles_IsFoundByLock) {
  stand_in_.run_process(90, "cornerd");
  stand_in_.write("/proc/locks", "1: POSIX  ADVISORY  WRITE 5 00:01:2 0 EOF\n" + lock_by(90));
  EXPECT_THAT(findings(), ElementsAre(Finds(Verdict::kGood, "holder", "cornerd (process 90)")));
}

TEST_F(CheckHolders, HiddenProcesses_GiveNote) {
  stand_in_.run_process(91, "secret");
  const auto found = findings();
  ASSERT_THAT(found,
              ElementsAre(Finds(Verdict::kNote, "holder", "no process that you may inspect")));
  EXPECT_THAT(found[0].remedies, ElementsAre(HasSubstr("sudo cornerctl doctor")));
}

TEST_F(CheckHolders, KernelConsole_IsWrong) {
  stand_in_.write("/sys/class/tty/console/active", "tty0 ttyUSB0\n");
  EXPECT_THAT(findings(), ElementsAre(Finds(Verdict::kWrong, "console", "/dev/ttyUSB0")));
}

TEST(LockOwner, LinesOfOtherFiles_GiveNoOwner) {
  FileFacts file;
  file.device_major = 0;
  file.device_minor = 5;
  file.inode = 345;
  EXPECT_EQ(lock_owner("1: FLOCK  ADVISORY  WRITE 1234 00:05:345 0 EOF", file), 1234);
  for (const char* line :
       {"1: FLOCK  ADVISORY  WRITE 1234 00:05:346 0 EOF",
        "1: -> FLOCK  ADVISORY  WRITE 7 00:05:345", "1: FLOCK  ADVISORY  WRITE -1 00:05:345 0 EOF",
        "1: FLOCK  ADVISORY  WRITE x 00:05:345 0 EOF", "1: FLOCK  ADVISORY  WRITE 1234 00:05 0 EOF",
        "", "nonsense"}) {
    EXPECT_FALSE(lock_owner(line, file)) << line;
  }
}

}  // namespace
}  // namespace cornerd::tool
