// SPDX-License-Identifier: MIT
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "doctor/stand_in.hpp"
#include "tool/doctor/checks.hpp"

namespace cornerd::tool {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

class CheckClaimers : public testing::Test {
 protected:
  CheckClaimers() { stand_in_.plug_in(); }
  std::vector<Finding> findings() const { return check_claimers(stand_in_.patient); }
  StandIn stand_in_;
};

TEST_F(CheckClaimers, NoClaimerInstalled_IsGood) {
  EXPECT_THAT(findings(), ElementsAre(Finds(Verdict::kGood, "claimers", "neither")));
}

TEST_F(CheckClaimers, GpsdWithUsbAuto_IsWrong) {
  stand_in_.write("/etc/default/gpsd", "# comment\nDEVICES=\"\"\nUSBAUTO=\"true\"\n");
  const auto found = findings();
  ASSERT_THAT(found, ElementsAre(Finds(Verdict::kWrong, "gpsd", "every CP2102")));
  EXPECT_THAT(found[0].remedies,
              ElementsAre(HasSubstr("udev rules"), HasSubstr("USBAUTO=\"false\"")));
  stand_in_.write("/etc/default/gpsd", "USBAUTO=\"true\"\nUSBAUTO='false'\n");
  EXPECT_THAT(findings(), ElementsAre(Finds(Verdict::kGood, "gpsd", "leaves the port alone")));
}

TEST_F(CheckClaimers, UdevRulesInstalled_GpsdIsGood) {
  stand_in_.write("/etc/default/gpsd", "USBAUTO=\"true\"\n");
  stand_in_.write("/etc/udev/rules.d/61-cornerd.rules");
  EXPECT_THAT(findings(), ElementsAre(Finds(Verdict::kGood, "gpsd", "leaves the port alone")));
  // Plugged in before they were there.
  stand_in_.write("/run/udev/data/c188:0", "E:SYSTEMD_WANTS=gpsdctl@ttyUSB0.service\n");
  EXPECT_THAT(findings(), ElementsAre(Finds(Verdict::kWrong, "gpsd", "every CP2102")));
  stand_in_.write("/run/udev/data/c188:0", "E:ID_MODEL=CP2102\n");
  EXPECT_THAT(findings(), ElementsAre(Finds(Verdict::kGood, "gpsd", "leaves the port alone")));
}

TEST_F(CheckClaimers, GpsdWithPortInDevices_IsWrong) {
  stand_in_.write("/etc/default/gpsd", "DEVICES=\"/dev/ttyS1 /dev/rplidar\"\nUSBAUTO=\"false\"\n");
  EXPECT_THAT(findings(),
              ElementsAre(Finds(Verdict::kWrong, "gpsd", "configured to read /dev/ttyUSB0")));
}

TEST_F(CheckClaimers, GpsdWithBoardUart_IsGood) {
  stand_in_.patient.config.lidar.device = "/dev/ttyS4";
  stand_in_.write("/dev/ttyS4");
  stand_in_.write("/etc/default/gpsd", "USBAUTO=\"true\"\n");
  stand_in_.run_process(9, "ModemManager");
  EXPECT_THAT(findings(), ElementsAre(Finds(Verdict::kGood, "gpsd", "leaves the port alone")));
}

TEST_F(CheckClaimers, ModemManagerWithoutUdevIgnoreFlag_IsWrong) {
  stand_in_.run_process(9, "ModemManager");
  const auto found = findings();
  ASSERT_THAT(found, ElementsAre(Finds(Verdict::kWrong, "modems", "ModemManager probes")));
  EXPECT_THAT(found[0].remedies, ElementsAre(HasSubstr("udev rules"), HasSubstr("mask --now")));
  stand_in_.write("/run/udev/data/c188:0", "S:rplidar\nE:ID_MM_PORT_IGNORE=1\n");
  EXPECT_THAT(findings(), ElementsAre(Finds(Verdict::kGood, "modems", "leaves the port alone")));
}

TEST_F(CheckClaimers, BrlttyRunning_IsWrong) {
  stand_in_.run_process(9, "brltty");
  EXPECT_THAT(findings(), ElementsAre(Finds(Verdict::kWrong, "brltty", "Braille")));
  EXPECT_THAT(findings()[0].what, Not(HasSubstr("probably has the lidar's")));
}

TEST_F(CheckClaimers, BrlttyAndNoPort_IsProbableCause) {
  // The driver is off it: neither port nor link are left.
  for (const char* file : {"/dev/rplidar", "/dev/ttyUSB0", "/sys/class/tty/ttyUSB0"}) {
    std::filesystem::remove(stand_in_.outside(file));
  }
  stand_in_.run_process(9, "brltty");
  const auto found = findings();
  ASSERT_THAT(found, ElementsAre(Finds(Verdict::kWrong, "brltty", "probably has the lidar's")));
  EXPECT_THAT(found[0].remedies, ElementsAre(HasSubstr("apt remove brltty"), HasSubstr("plug")));
}

TEST(CheckClaimersOfNothing, NothingPluggedIn_ReportsAllClaimers) {
  const StandIn stand_in;
  EXPECT_THAT(check_claimers(stand_in.patient),
              ElementsAre(Finds(Verdict::kGood, "claimers", "neither")));
  stand_in.run_process(8, "ModemManager");
  stand_in.run_process(9, "brltty");
  stand_in.write("/etc/default/gpsd", "USBAUTO=\"true\"\n");
  EXPECT_THAT(check_claimers(stand_in.patient),
              ElementsAre(Finds(Verdict::kWrong, "gpsd", "every CP2102"),
                          Finds(Verdict::kWrong, "modems", "ModemManager probes"),
                          Finds(Verdict::kWrong, "brltty", "Braille")));
  stand_in.write("/etc/udev/rules.d/61-cornerd.rules");
  EXPECT_THAT(check_claimers(stand_in.patient),
              ElementsAre(Finds(Verdict::kGood, "gpsd", "leaves the port alone"),
                          Finds(Verdict::kGood, "modems", "leaves the port alone"),
                          Finds(Verdict::kWrong, "brltty", "Braille")));
}

TEST(CheckClaimersOfNothing, AbsentBoardUart_IsGood) {
  StandIn stand_in;
  stand_in.patient.config.lidar.device = "/dev/ttyS4";
  stand_in.run_process(8, "ModemManager");
  stand_in.run_process(9, "brltty");
  EXPECT_THAT(check_claimers(stand_in.patient),
              ElementsAre(Finds(Verdict::kGood, "claimers", "neither")));
}

TEST(CheckClaimersOfNothing, PortUnderAnotherName_UsesItsUdevData) {
  const StandIn stand_in;
  stand_in.plug_in_without_rules();
  stand_in.write("/etc/udev/rules.d/61-cornerd.rules");
  stand_in.run_process(8, "ModemManager");
  stand_in.write("/run/udev/data/c188:0", "E:ID_MODEL=CP2102\n");
  EXPECT_THAT(check_claimers(stand_in.patient),
              ElementsAre(Finds(Verdict::kWrong, "modems", "ModemManager probes")));
}

}  // namespace
}  // namespace cornerd::tool
