// SPDX-License-Identifier: MIT
#include "tool/doctor/service_unit.hpp"

#include <gmock/gmock.h>

#include "doctor/stand_in.hpp"

namespace cornerd::tool {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

class ServiceUnit : public testing::Test {
 protected:
  void install(const std::string& lines) const {
    stand_in_.write("/lib/systemd/system/cornerd.service", "[Service]\n" + lines);
  }
  void drop_in(const std::string& folder, const std::string& name, const std::string& lines) const {
    stand_in_.write(folder + "/systemd/system/cornerd.service.d/" + name, "[Service]\n" + lines);
  }
  std::vector<std::string> values() const {
    return service_unit_values(stand_in_.patient.machine, "DeviceAllow");
  }
  bool allows(const std::string& port) const {
    return service_unit_allows(stand_in_.patient.machine, port);
  }
  StandIn stand_in_;
};

TEST_F(ServiceUnit, NotInstalled_AllowsEverything) {
  EXPECT_FALSE(has_service_unit(stand_in_.patient.machine));
  EXPECT_TRUE(allows("/dev/ttyXY1"));
  drop_in("/etc", "a.conf", "DeviceAllow=char-ttyS rw\n");
  EXPECT_THAT(values(), IsEmpty()) << "a drop-in alone is no unit";
}

TEST_F(ServiceUnit, DropIns_AddAndReset) {
  install("DeviceAllow=char-ttyS rw\n# DeviceAllow=char-ttyZ rw\n");
  EXPECT_TRUE(has_service_unit(stand_in_.patient.machine));
  drop_in("/etc", "20.conf", "DeviceAllow = char-ttyXY rw \n");
  EXPECT_THAT(values(), ElementsAre("char-ttyS rw", "char-ttyXY rw"));
  drop_in("/run", "10.conf", "DeviceAllow=\n");
  EXPECT_THAT(values(), ElementsAre("char-ttyXY rw"));
  drop_in("/etc", "10.conf", "");
  EXPECT_THAT(values(), ElementsAre("char-ttyS rw", "char-ttyXY rw")) << "masks the other 10.conf";
  drop_in("/etc", "30.conf~", "DeviceAllow=\n");
  EXPECT_EQ(values().size(), 2U);
}

TEST_F(ServiceUnit, PortKindNotInDeviceAllow_IsDenied) {
  install("DevicePolicy=closed\nDeviceAllow=char-ttyS rw\nDeviceAllow=char-ttyUSB r\n");
  EXPECT_TRUE(allows("/dev/ttyS4"));
  EXPECT_FALSE(allows("/dev/ttySC0"));
  EXPECT_FALSE(allows("/dev/ttyUSB0")) << "may only be read";
  EXPECT_TRUE(allows("/dev/pts/3"));
  drop_in("/etc", "a.conf", "DeviceAllow=char-ttyS?\nDeviceAllow=/dev/lidar rw\n");
  EXPECT_TRUE(allows("/dev/ttySC0"));
  EXPECT_FALSE(allows("/dev/ttyXY1"));
  stand_in_.link("/dev/lidar", "ttyXY1");
  EXPECT_TRUE(allows("/dev/ttyXY1"));
}

TEST_F(ServiceUnit, NoPolicyAndNoList_AllowsEverything) {
  install("DevicePolicy=auto\n");
  EXPECT_TRUE(allows("/dev/ttyXY1"));
  install("DevicePolicy=closed\n");
  EXPECT_FALSE(allows("/dev/ttyXY1"));
}

TEST(PortKind, DeviceName_WithoutItsNumber) {
  EXPECT_EQ(port_kind("/dev/ttymxc3"), "ttymxc");
  EXPECT_EQ(port_kind("/dev/ttyS12"), "ttyS");
}

/// The unit of the package.
TEST_F(ServiceUnit, PackagedUnit_AllowsCommonKinds) {
  std::filesystem::create_directories(stand_in_.outside("/lib/systemd/system"));
  std::filesystem::copy_file(CORNERD_SOURCE_DIR "/systemd/cornerd.service",
                             stand_in_.outside("/lib/systemd/system/cornerd.service"));
  for (const char* port : {"/dev/ttyUSB0", "/dev/ttyACM0", "/dev/ttyS4", "/dev/ttyAMA0",
                           "/dev/ttyO4", "/dev/ttymxc1", "/dev/ttyTHS1"}) {
    EXPECT_TRUE(allows(port)) << port;
  }
  EXPECT_FALSE(allows("/dev/tty1")) << "a console";
  EXPECT_FALSE(allows("/dev/sda1"));
}

}  // namespace
}  // namespace cornerd::tool
