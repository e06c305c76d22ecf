// SPDX-License-Identifier: MIT
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include "doctor/stand_in.hpp"
#include "tool/doctor/checks.hpp"

namespace cornerd::tool {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::StartsWith;

TEST(CheckPort, PresentPort_IsGoodAndNamed) {
  const StandIn stand_in;
  stand_in.plug_in();
  EXPECT_THAT(check_port(stand_in.patient),
              ElementsAre(Finds(Verdict::kGood, "port",
                                "/dev/rplidar -> /dev/ttyUSB0 (CP2102 USB to UART Bridge "
                                "Controller, 10c4:ea60)")));
}

TEST(CheckPort, AdapterWithoutRules_IsFoundByItsKernelName) {
  const StandIn stand_in;
  stand_in.plug_in_without_rules();
  auto findings = check_port(stand_in.patient);
  ASSERT_THAT(findings, ElementsAre(Finds(Verdict::kWrong, "port", "there is /dev/ttyUSB0")));
  EXPECT_THAT(findings[0].remedies,
              ElementsAre(StartsWith("install systemd/61-cornerd.rules"),
                          "or set lidar.device to \"/dev/ttyUSB0\" in cornerd.json"));
  stand_in.write("/lib/udev/rules.d/61-cornerd.rules");
  EXPECT_THAT(check_port(stand_in.patient)[0].remedies[0], StartsWith("sudo udevadm control"));
}

TEST(CheckPort, WrongUsbPort_OtherNameIsProposed) {
  StandIn stand_in;
  stand_in.plug_in_without_rules();
  stand_in.patient.config.lidar.device = "/dev/ttyUSB1";
  EXPECT_THAT(check_port(stand_in.patient)[0].remedies,
              ElementsAre("set lidar.device to \"/dev/ttyUSB0\" in cornerd.json"));
}

TEST(CheckPort, SecondAdapter_IsMentioned) {
  const StandIn stand_in;
  stand_in.plug_in();
  stand_in.write("/sys/devices/pci0/usb1/1-2/idVendor", "1a86\n");
  stand_in.write("/sys/devices/pci0/usb1/1-2/idProduct", "7523\n");
  stand_in.link("/sys/class/tty/ttyUSB1", "../../devices/pci0/usb1/1-2");
  EXPECT_THAT(
      check_port(stand_in.patient),
      ElementsAre(Finds(Verdict::kGood, "port", "also plugged in: /dev/ttyUSB1 (1a86:7523)")));
}

TEST(CheckPort, AdapterWithoutDriver_RemedyIsModprobe) {
  const StandIn stand_in;
  stand_in.write("/sys/bus/usb/devices/1-1/idVendor", "10c4\n");
  stand_in.write("/sys/bus/usb/devices/1-1/idProduct", "ea60\n");
  const auto findings = check_port(stand_in.patient);
  ASSERT_THAT(findings, ElementsAre(Finds(Verdict::kWrong, "port", "without a driver")));
  EXPECT_THAT(findings[0].remedies, ElementsAre("sudo modprobe cp210x"));
}

TEST(CheckPort, NotASerialPort_IsWrongWithoutFurtherChecks) {
  StandIn stand_in;
  stand_in.plug_in();
  const auto expect_wrong = [&](const char* device, const char* what) {
    stand_in.patient.config.lidar.device = device;
    const auto findings = check_port(stand_in.patient);
    ASSERT_THAT(findings, ElementsAre(Finds(Verdict::kWrong, "port", what)));
    EXPECT_THAT(findings[0].remedies,
                testing::Contains("set lidar.device to \"/dev/ttyUSB0\" in cornerd.json"));
    EXPECT_TRUE(check_rights(stand_in.patient).empty());
    EXPECT_TRUE(check_holders(stand_in.patient).empty());
  };
  stand_in.write("/tmp/file");
  expect_wrong("/tmp/file", "/tmp/file: no serial port, but an ordinary file");
  expect_wrong("/tmp", "/tmp: no serial port, but a folder");
  ASSERT_EQ(::mkfifo(stand_in.outside("/tmp/pipe").c_str(), 0600), 0);
  expect_wrong("/tmp/pipe", "/tmp/pipe: no serial port, but a named pipe");
  stand_in.write("/dev/null");
  stand_in.be_no_terminal();
  expect_wrong("/dev/null", "/dev/null: no serial port, but a device of the kind \"mem\"");
}

TEST(CheckPort, ControllingTerminal_IsAPort) {
  const Machine machine;
  const std::optional<FileFacts> terminal = machine.facts("/dev/tty");
  if (!terminal) GTEST_SKIP() << "there is no /dev/tty";
  EXPECT_EQ(other_than_port(machine, *terminal), "");
}

TEST(CheckPort, NothingPluggedIn_RemediesArePlugAndCable) {
  const StandIn stand_in;
  const auto findings = check_port(stand_in.patient);
  ASSERT_THAT(findings, ElementsAre(Finds(Verdict::kWrong, "port", "/dev/rplidar: no such port")));
  EXPECT_THAT(findings[0].remedies,
              ElementsAre(HasSubstr("plug the lidar in"), HasSubstr("cable")));
}

TEST(CheckPort, BoardUart_HasRemedyForItsCause) {
  StandIn stand_in;
  stand_in.patient.config.lidar.device = "/dev/ttyO4";
  EXPECT_THAT(check_port(stand_in.patient)[0].remedies, ElementsAre(HasSubstr("\"/dev/ttyS4\"")));
  stand_in.patient.config.lidar.device = "/dev/ttyS4";
  EXPECT_THAT(check_port(stand_in.patient)[0].remedies, ElementsAre(HasSubstr("overlay")));
  stand_in.write("/dev/ttyS4");
  stand_in.write("/sys/class/tty/ttyS4/type", "0\n");
  EXPECT_THAT(check_port(stand_in.patient),
              ElementsAre(Finds(Verdict::kWrong, "port", "no UART behind it")));
  stand_in.write("/sys/class/tty/ttyS4/type", "4\n");
  EXPECT_THAT(check_port(stand_in.patient), ElementsAre(Finds(Verdict::kGood, "port", "ttyS4")));
}

TEST(CheckPort, AbsentRecording_IsWrong) {
  StandIn stand_in;
  stand_in.patient.config.lidar.driver = settings::DriverKind::kReplay;
  stand_in.patient.config.lidar.file = "/drive.bin";
  EXPECT_THAT(check_port(stand_in.patient),
              ElementsAre(Finds(Verdict::kWrong, "lidar", "no such recording")));
  stand_in.write("/drive.bin");
  EXPECT_THAT(check_port(stand_in.patient),
              ElementsAre(Finds(Verdict::kNote, "lidar", "/drive.bin")));
}

}  // namespace
}  // namespace cornerd::tool
