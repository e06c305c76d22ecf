// SPDX-License-Identifier: MIT
#include "daemon/unix_listener.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <atomic>
#include <fstream>
#include <optional>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "captured_log.hpp"
#include "test_client.hpp"
#include "tests/temporary_folder.hpp"

namespace cornerd::daemon {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

std::string error_of(const std::filesystem::path& path) {
  try {
    const UnixListener listener(path, 0600);
  } catch (const std::exception& error) {
    return error.what();
  }
  return {};
}

/// Leaves a stale socket file, as a killed daemon does.
void leave_stale_socket(const std::filesystem::path& path) {
  const FileDescriptor fd(::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0));
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  std::strncpy(address.sun_path, path.c_str(), sizeof(address.sun_path) - 1);
  ASSERT_EQ(::bind(fd.get(), reinterpret_cast<const sockaddr*>(&address), sizeof(address)), 0);
}

TEST(UnixListener, Client_Connects_Accepted) {
  const test::TemporaryFolder folder;
  UnixListener listener(folder / "s", 0600);
  EXPECT_FALSE(listener.accept().is_open());
  const TestClient client(folder / "s");
  EXPECT_TRUE(client.is_connected());
  EXPECT_TRUE(listener.accept().is_open());
}

TEST(UnixListener, OutOfDescriptors_ClientDisconnected) {
  const test::TemporaryFolder folder;
  UnixListener listener(folder / "s", 0600);
  TestClient client(folder / "s");
  rlimit limit{};
  ASSERT_EQ(::getrlimit(RLIMIT_NOFILE, &limit), 0);
  const FileDescriptor lowest(::dup(listener.fd()));
  const rlimit full{static_cast<rlim_t>(lowest.get()), limit.rlim_max};
  ASSERT_EQ(::setrlimit(RLIMIT_NOFILE, &full), 0);
  const CapturedLog log;
  EXPECT_FALSE(listener.accept().is_open());
  EXPECT_EQ(client.read_line(0), std::nullopt);
  EXPECT_TRUE(client.has_ended());
  EXPECT_EQ(::setrlimit(RLIMIT_NOFILE, &limit), 0);
  const std::string words = "of at most " + std::to_string(lowest.get()) +
                            " in this process: raise `ulimit -n`, or LimitNOFILE=";
  EXPECT_NE(log.text().find(words), std::string::npos) << log.text();
  const TestClient next(folder / "s");
  EXPECT_TRUE(listener.accept().is_open());
}

TEST(UnixListener, RemovedFile_Noticed) {
  const test::TemporaryFolder folder;
  const UnixListener listener(folder / "s", 0600);
  EXPECT_EQ(listener.file(), UnixListener::File::kOwn);
  std::filesystem::remove(folder / "s");
  EXPECT_EQ(listener.file(), UnixListener::File::kRemoved);
}

TEST(UnixListener, ReplacedFile_NoticedAndKept) {
  const test::TemporaryFolder folder;
  {
    const UnixListener listener(folder / "s", 0600);
    std::filesystem::rename(folder / "s", folder / "moved");
    std::ofstream(folder / "s") << "precious";
    EXPECT_EQ(listener.file(), UnixListener::File::kReplaced);
  }
  EXPECT_TRUE(std::filesystem::exists(folder / "s"));
}

TEST(UnixListener, ModeThatDeniesClients_Noticed) {
  const test::TemporaryFolder folder;
  const UnixListener listener(folder / "s", 0660);
  ASSERT_EQ(::chmod((folder / "s").c_str(), 0600), 0);
  EXPECT_EQ(listener.file(), UnixListener::File::kClosed);
  ASSERT_EQ(::chmod((folder / "s").c_str(), 0666), 0);
  EXPECT_EQ(listener.file(), UnixListener::File::kOwn) << "all who could connect can";
}

TEST(UnixListener, FolderThatCannotBeMade_IsNamedWithItsReason) {
  EXPECT_THAT(error_of("/proc/none/s"),
              StartsWith("/proc/none: cannot create the socket's folder"));
}

TEST(UnixListener, SimultaneousStarts_OneListens) {
  const test::TemporaryFolder folder;
  for (int round = 0; round < 20; ++round) {
    leave_stale_socket(folder / "s");
    std::atomic<int> refused{0};
    std::vector<std::optional<UnixListener>> listeners(4);
    {
      std::vector<std::jthread> starters;
      for (auto& listener : listeners) {
        starters.emplace_back([&] {
          try {
            listener.emplace(folder / "s", 0600);
          } catch (const std::runtime_error&) {
            ++refused;
          }
        });
      }
    }
    EXPECT_EQ(refused, 3);
    EXPECT_TRUE(TestClient(folder / "s").is_connected());
  }
}

TEST(UnixListener, Mode_AnyUmask_AsRequested) {
  const test::TemporaryFolder folder;
  const mode_t before = ::umask(0077);
  const UnixListener listener(folder / "s", 0666);
  ::umask(before);
  struct stat file {};
  ASSERT_EQ(::stat((folder / "s").c_str(), &file), 0);
  EXPECT_EQ(file.st_mode & 0777, 0666u);
}

TEST(UnixListener, Destructor_RemovesFile) {
  const test::TemporaryFolder folder;
  { const UnixListener listener(folder / "s", 0600); }
  EXPECT_FALSE(std::filesystem::exists(folder / "s"));
}

TEST(UnixListener, Destructor_LeavesReplacedFile) {
  const test::TemporaryFolder folder;
  std::optional<UnixListener> first;
  first.emplace(folder / "s", 0600);
  std::filesystem::rename(folder / "s", folder / "moved");
  const UnixListener second(folder / "s", 0600);
  first.reset();
  EXPECT_TRUE(TestClient(folder / "s").is_connected());
}

TEST(UnixListener, StaleFile_Replaced) {
  const test::TemporaryFolder folder;
  leave_stale_socket(folder / "s");
  const UnixListener listener(folder / "s", 0600);
  EXPECT_TRUE(TestClient(folder / "s").is_connected());
}

TEST(UnixListener, SocketOfLiveInstance_LeftAlone) {
  const test::TemporaryFolder folder;
  const UnixListener first(folder / "s", 0600);
  EXPECT_THAT(error_of(folder / "s"),
              StartsWith((folder / "s").string() + ": another cornerd listens on this socket"));
  EXPECT_TRUE(TestClient(folder / "s").is_connected());
}

/// Drops root privileges, so that file modes apply.
class Unprivileged {
 public:
  explicit Unprivileged(const std::filesystem::path& folder) {
    if (::geteuid() != 0) return;
    static_cast<void>(::chown(folder.c_str(), kNobody, kNobody));
    was_root_ = ::seteuid(kNobody) == 0;
  }
  ~Unprivileged() {
    if (was_root_) static_cast<void>(::seteuid(0));
  }
  Unprivileged(const Unprivileged&) = delete;
  Unprivileged& operator=(const Unprivileged&) = delete;

 private:
  static constexpr uid_t kNobody = 65534;
  bool was_root_ = false;
};

TEST(UnixListener, StaleFileOfAnotherUser_Replaced) {
  const test::TemporaryFolder folder;
  leave_stale_socket(folder / "s");
  ASSERT_EQ(::chmod((folder / "s").c_str(), 0), 0);
  const Unprivileged user(folder.path());
  const UnixListener listener(folder / "s", 0600);
  EXPECT_TRUE(TestClient(folder / "s").is_connected());
}

TEST(UnixListener, SocketOfAnotherUsersLiveInstance_LeftAlone) {
  const test::TemporaryFolder folder;
  const UnixListener first(folder / "s", 0);
  const Unprivileged user(folder.path());
  EXPECT_THAT(
      error_of(folder / "s"),
      StartsWith((folder / "s").string() + ": another user's cornerd listens on this socket"));
  EXPECT_EQ(first.file(), UnixListener::File::kOwn);
}

TEST(UnixListener, UnremovableStaleFile_NamedInError) {
  const test::TemporaryFolder folder;
  leave_stale_socket(folder / "s");
  const Unprivileged user(folder.path());
  ASSERT_EQ(::chmod(folder.path().c_str(), 0500), 0);
  EXPECT_THAT(error_of(folder / "s"), HasSubstr("cannot remove the stale socket: "));
  ASSERT_EQ(::chmod(folder.path().c_str(), 0700), 0);
}

TEST(UnixListener, NotASocket_LeftAlone) {
  const test::TemporaryFolder folder;
  std::ofstream(folder / "s") << "precious";
  EXPECT_THAT(error_of(folder / "s"), HasSubstr("is not a socket"));
  EXPECT_EQ(std::filesystem::file_size(folder / "s"), 8u);
}

TEST(UnixListener, MissingFolder_Created) {
  const test::TemporaryFolder folder;
  const UnixListener listener(folder / "run" / "s", 0600);
  EXPECT_TRUE(std::filesystem::exists(folder / "run"));
}

TEST(UnixListener, InvalidPath_NamedInError) {
  EXPECT_THAT(error_of("/nowhere/at/all/s"),
              StartsWith("/nowhere/at/all: cannot create the socket's folder: "));
  EXPECT_THAT(error_of("/tmp/" + std::string(200, 'x')), HasSubstr("too long for a socket"));
}

}  // namespace
}  // namespace cornerd::daemon
