// SPDX-License-Identifier: MIT
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "doctor/stand_in.hpp"
#include "tool/doctor/checks.hpp"

namespace cornerd::tool {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

class CheckPower : public testing::Test {
 protected:
  CheckPower() { stand_in_.plug_in(); }
  std::vector<Finding> findings() const { return check_power(stand_in_.patient); }
  StandIn stand_in_;
};

TEST_F(CheckPower, NoFault_NamesItsSource) {
  EXPECT_THAT(findings(), ElementsAre(Finds(Verdict::kGood, "power", "sudo cornerctl doctor")));
  stand_in_.write("/dev/kmsg", "6,1,0,-;usb 1-1: new full-speed USB device\n");
  const auto found = findings();
  ASSERT_THAT(found, ElementsAre(Finds(Verdict::kGood, "power", "no trace of trouble")));
  EXPECT_EQ(found[0].what, "no trace of trouble");
}

TEST_F(CheckPower, UsbOverCurrent_IsWrong) {
  const std::string hub = "/sys/bus/usb/devices/1-0:1.0";
  stand_in_.write(hub + "/usb1-port1/over_current_count", "3\n");
  stand_in_.write(hub + "/usb1-port2/over_current_count", "0\n");
  const auto found = findings();
  ASSERT_THAT(found, ElementsAre(Finds(Verdict::kWrong, "power", "3 times")));
  EXPECT_THAT(found[0].remedies, ElementsAre(HasSubstr("stronger supply")));
}

TEST_F(CheckPower, UndervoltageAlarm_IsWrong) {
  stand_in_.write("/sys/class/hwmon/hwmon0/in0_lcrit_alarm", "0\n");
  EXPECT_THAT(findings(), ElementsAre(Finds(Verdict::kGood, "power", "no trace")));
  stand_in_.write("/sys/class/hwmon/hwmon0/in0_lcrit_alarm", "1\n");
  EXPECT_THAT(findings(), ElementsAre(Finds(Verdict::kWrong, "power", "supply is too low")));
}

TEST_F(CheckPower, HubWithoutSupply_IsNoted) {
  // usb1 is the root hub of the computer; an external hub has another name.
  stand_in_.write("/sys/devices/pci0/usb1/bmAttributes", "a0\n");
  EXPECT_THAT(findings(), ElementsAre(Finds(Verdict::kGood, "power", "no trace")));

  StandIn behind_hub;
  const std::string hub = "/sys/devices/pci0/usb1/1-1";
  behind_hub.link("/dev/rplidar", "ttyUSB0");
  behind_hub.write("/dev/ttyUSB0");
  behind_hub.write(hub + "/bmAttributes", "e0\n");
  behind_hub.write(hub + "/1-1.2/idVendor", "10c4\n");
  behind_hub.write(hub + "/1-1.2/tty/ttyUSB0/dev", "188:0\n");
  behind_hub.link("/sys/class/tty/ttyUSB0", "../../devices/pci0/usb1/1-1/1-1.2/tty/ttyUSB0");
  EXPECT_THAT(check_power(behind_hub.patient),
              ElementsAre(Finds(Verdict::kGood, "power", "no trace")));
  behind_hub.write(hub + "/bmAttributes", "a0\n");
  EXPECT_THAT(check_power(behind_hub.patient),
              ElementsAre(Finds(Verdict::kNote, "power", "hub without its own supply")));
}

TEST_F(CheckPower, FaultsInKernelLog_AreCounted) {
  stand_in_.write("/dev/kmsg",
                  "3,1,0,-;cp210x ttyUSB0: cp210x converter now disconnected from ttyUSB0\n"
                  "3,2,9,-;cp210x ttyUSB0: cp210x converter now disconnected from ttyUSB0\n"
                  "4,3,9,-;hwmon hwmon1: Undervoltage detected!\n");
  EXPECT_THAT(findings(),
              ElementsAre(Finds(Verdict::kNote, "power", "too low, 1 time in"),
                          Finds(Verdict::kNote, "power", "unplugged or lost its power, 2 times")));
}

}  // namespace
}  // namespace cornerd::tool
