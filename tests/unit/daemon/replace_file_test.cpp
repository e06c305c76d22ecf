// SPDX-License-Identifier: MIT
#include "daemon/replace_file.hpp"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <system_error>
#include <vector>

#include "tests/temporary_folder.hpp"

namespace {

std::filesystem::path watched_file;
/// Sizes of the watched file at each fsync().
std::vector<std::uintmax_t> sizes_at_sync;
std::vector<std::uintmax_t> synced_sizes;

}  // namespace

extern "C" int fsync(int fd) {
  struct stat synced {};
  if (!watched_file.empty() && ::fstat(fd, &synced) == 0) {
    sizes_at_sync.push_back(std::filesystem::file_size(watched_file));
    if (S_ISREG(synced.st_mode))
      synced_sizes.push_back(static_cast<std::uintmax_t>(synced.st_size));
  }
  return static_cast<int>(::syscall(SYS_fsync, fd));
}

namespace cornerd::daemon {
namespace {

TEST(ReplaceFile, NewContent_SyncedBeforeRename) {
  const test::TemporaryFolder folder;
  std::ofstream(folder / "f") << "old";
  watched_file = folder / "f";
  sizes_at_sync.clear();
  synced_sizes.clear();
  replace_file(folder / "f", "longer");
  watched_file.clear();
  EXPECT_EQ(synced_sizes, std::vector<std::uintmax_t>{6});
  EXPECT_EQ(sizes_at_sync, (std::vector<std::uintmax_t>{3, 6}));
  EXPECT_FALSE(std::filesystem::exists(folder / "f.new"));
}

TEST(ReplaceFile, UnreplaceableFile_ThrowsAndStays) {
  const test::TemporaryFolder folder;
  std::filesystem::create_directories(folder / "f" / "inside");
  EXPECT_THROW(replace_file(folder / "f", "new"), std::system_error);
  EXPECT_TRUE(std::filesystem::exists(folder / "f" / "inside"));
  EXPECT_FALSE(std::filesystem::exists(folder / "f.new"));
  EXPECT_THROW(replace_file(folder / "none" / "f", "new"), std::system_error);
}

}  // namespace
}  // namespace cornerd::daemon
