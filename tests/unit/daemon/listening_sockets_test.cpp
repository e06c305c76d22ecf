// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include "daemon/unix_listener.hpp"
#include "tests/temporary_folder.hpp"

namespace cornerd::daemon {
namespace {

bool is_listed(const std::string& file, const std::string& list) {
  std::istringstream lines(list);
  return is_listening(file, lines);
}

TEST(IsListening, KernelList_MatchedByFlagsAndPath) {
  const std::string row = "0000000000000000: 00000002 00000000 00010000 0001 01 1276 ";
  EXPECT_TRUE(is_listed("/run/a b.sock", row + "/run/a b.sock\n"));
  EXPECT_TRUE(is_listed("/run/a.sock", "junk\n" + row + "/run/b.sock\n" + row + "a.sock\n"));
  EXPECT_FALSE(is_listed("/run/a.sock", row + "/run/b.sock\n" + row + "\n"));
  EXPECT_FALSE(is_listed("/run/a.sock", row + "@/run/a.sock.\n"));
  // Connected, not listening.
  EXPECT_FALSE(is_listed("/run/a.sock",
                         "0000000000000000: 00000003 00000000 00000000 0001 03 77 /run/a.sock\n"));
}

TEST(IsListening, LiveSocketByAnotherName_Found) {
  const test::TemporaryFolder folder;
  const std::filesystem::path by_link = folder / "link" / "s";
  std::filesystem::create_directory(folder / "real");
  std::filesystem::create_directory_symlink(folder / "real", folder / "link");
  {
    const UnixListener listener(folder / "real" / "s", 0600);
    EXPECT_EQ(is_listening(by_link), true);
  }
  std::ofstream(by_link) << "";
  EXPECT_EQ(is_listening(by_link), false);
}

}  // namespace
}  // namespace cornerd::daemon
