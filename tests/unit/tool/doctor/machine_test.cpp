// SPDX-License-Identifier: MIT
#include "tool/doctor/machine.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "doctor/stand_in.hpp"

namespace cornerd::tool {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

TEST(Machine, Links_AreFollowedInsideRoot) {
  const StandIn stand_in;
  stand_in.write("/dev/ttyS4", "port");
  stand_in.link("/dev/lidar", "/dev/uart");
  stand_in.link("/dev/uart", "ttyS4");
  stand_in.link("/sys/class/x", "../devices/../devices/y");
  stand_in.write("/sys/devices/y/name", "Y\nmore");
  const Machine& machine = stand_in.patient.machine;
  EXPECT_EQ(machine.resolve("/dev/lidar"), "/dev/ttyS4");
  EXPECT_EQ(machine.read("/dev/lidar"), "port");
  EXPECT_EQ(machine.resolve("/sys/class/x/name"), "/sys/devices/y/name");
  EXPECT_EQ(machine.read_line("/sys/class/x/name"), "Y");
}

TEST(Machine, Steps_ListEveryPathOfLookup) {
  const StandIn stand_in;
  stand_in.write("/data/maps/a.json");
  stand_in.link("/etc/maps", "../data/maps");
  EXPECT_THAT(stand_in.patient.machine.steps("/etc/maps/a.json"),
              ElementsAre("/etc", "/etc/maps", "/data", "/data/maps", "/data/maps/a.json"));
}

TEST(Machine, LinkToItself_Ends) {
  const StandIn stand_in;
  stand_in.link("/dev/loop", "loop");
  EXPECT_FALSE(stand_in.patient.machine.exists("/dev/loop"));
}

TEST(Machine, AbsentFile_IsEmpty) {
  const StandIn stand_in;
  const Machine& machine = stand_in.patient.machine;
  EXPECT_FALSE(machine.exists("/nothing"));
  EXPECT_FALSE(machine.read("/nothing"));
  EXPECT_FALSE(machine.facts("/nothing"));
  EXPECT_EQ(machine.read_line("/nothing"), "");
  EXPECT_EQ(machine.read_link("/nothing"), "");
  EXPECT_THAT(machine.list("/nothing"), IsEmpty());
}

TEST(Machine, List_IsSorted) {
  const StandIn stand_in;
  for (const char* name : {"/d/b", "/d/a", "/d/c"}) stand_in.write(name);
  EXPECT_THAT(stand_in.patient.machine.list("/d"), ElementsAre("a", "b", "c"));
}

TEST(SplitWords, Separators_Merge) {
  EXPECT_THAT(split_words("  a b\t\tc ", " \t"), ElementsAre("a", "b", "c"));
  EXPECT_THAT(split_words("", " "), IsEmpty());
}

}  // namespace
}  // namespace cornerd::tool
