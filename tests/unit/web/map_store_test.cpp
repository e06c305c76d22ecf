// SPDX-License-Identifier: MIT
#include "web/map_store.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include "tests/temporary_folder.hpp"

namespace cornerd::web {
namespace {

constexpr const char* kMap =
    R"({"format":"cornerd-map","version":1,"walls":[{"from":[0,0],"to":[2,0]}]})";

TEST(MapName, LeavesNoFolder) {
  EXPECT_TRUE(is_map_name("floor-2_b.new"));
  for (const char* name : {"", ".", "..", ".hidden", "../a", "a/b", "a b", "a\n"}) {
    EXPECT_FALSE(is_map_name(name)) << name;
  }
  EXPECT_FALSE(is_map_name(std::string(65, 'a')));
}

TEST(MapStore, SavedMap_IsListedAndNeverReplaced) {
  const test::TemporaryFolder folder;
  const MapStore store(folder.path());
  std::ofstream(folder / "learned.json") << R"({"format":"cornerd-learned"})";
  std::filesystem::create_directory(folder / "plans.json");
  EXPECT_EQ(store.put("hall", kMap).status, 201u);
  const Response again = store.put("hall", kMap);
  EXPECT_EQ(again.status, 409u);
  EXPECT_NE(again.body.find("exists"), std::string::npos);
  EXPECT_EQ(store.list().body,
            "[{\"file\":\"" + (folder / "hall.json").string() + "\",\"name\":\"hall\"}]\n");
  std::ifstream file(folder / "hall.json");
  std::ostringstream text;
  text << file.rdbuf();
  EXPECT_EQ(text.str(), kMap);
}

TEST(MapStore, WrongMap_IsRefusedWithItsReasonAndLeavesNothing) {
  const test::TemporaryFolder folder;
  const MapStore store(folder.path());
  const Response refused = store.put("bad", R"({"format":"cornerd-map","version":1,"walls":[]})");
  EXPECT_EQ(refused.status, 422u);
  EXPECT_NE(refused.body.find("/walls"), std::string::npos) << refused.body;
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
  EXPECT_EQ(store.put("../bad", kMap).status, 400u);
  EXPECT_EQ(MapStore({}).put("hall", kMap).status, 404u);
}

}  // namespace
}  // namespace cornerd::web
