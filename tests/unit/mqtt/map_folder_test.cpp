// SPDX-License-Identifier: MIT
#include "mqtt/map_folder.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <system_error>

#include "tests/temporary_folder.hpp"

namespace cornerd::mqtt {
namespace {

constexpr const char* kMap =
    R"({"format":"cornerd-map","version":1,"walls":[{"from":[0,0],"to":[2,0]}]})";

TEST(MapFolder, OtherFiles_AreNotAmongIts) {
  const test::TemporaryFolder folder;
  for (const char* name : {"hall.1.json", "hall.12.json", "hall.x.json", "hall.json", "hall..json",
                           "hall2.1.json", "other.1.json", "hall.3.json.bak"}) {
    std::ofstream(folder / name) << kMap;
  }
  const MapFolder maps(folder / "", "hall");
  ASSERT_EQ(maps.files().size(), 2u);
  EXPECT_EQ(maps.files()[0].version, 12u);
}

TEST(MapFolder, AddedFile_IsThereForTheNextRun) {
  const test::TemporaryFolder folder;
  {
    MapFolder maps(folder / "", "hall");
    for (const std::uint64_t version : {1, 2, 3}) maps.add(version, kMap);
    maps.drop_newest();
  }
  const MapFolder maps(folder / "", "hall");
  ASSERT_EQ(maps.files().size(), 1u);
  EXPECT_EQ(maps.files()[0].version, 2u);
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder / ""), {}), 1);
}

TEST(MapFolder, AbsentFolder_Throws) {
  const test::TemporaryFolder folder;
  MapFolder maps(folder / "absent", "hall");
  EXPECT_TRUE(maps.files().empty());
  EXPECT_THROW(maps.add(1, kMap), std::system_error);
}

}  // namespace
}  // namespace cornerd::mqtt
