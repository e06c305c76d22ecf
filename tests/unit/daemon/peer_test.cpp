// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>

#include "daemon/require_fd.hpp"
#include "daemon/unix_listener.hpp"

namespace cornerd::daemon {
namespace {

constexpr uid_t kOwner = 200;
constexpr gid_t kGroup = 300;

TEST(Peer, RootOwnerAndMembers_Belong) {
  EXPECT_TRUE(belongs_to({.user = 0, .group = 0, .other_groups = {}}, kGroup, kOwner));
  EXPECT_TRUE(belongs_to({.user = kOwner, .group = 1, .other_groups = {}}, kGroup, kOwner));
  EXPECT_TRUE(belongs_to({.user = 7, .group = kGroup, .other_groups = {}}, kGroup, kOwner));
  EXPECT_TRUE(belongs_to({.user = 7, .group = 1, .other_groups = {2, kGroup}}, kGroup, kOwner));
}

TEST(Peer, OtherUser_DoesNotBelong) {
  EXPECT_FALSE(belongs_to({.user = 7, .group = 1, .other_groups = {2, 3}}, kGroup, kOwner));
}

TEST(Peer, Connection_CredentialsOfItsProcess) {
  std::array<int, 2> ends{};
  ASSERT_EQ(::socketpair(AF_UNIX, SOCK_STREAM, 0, ends.data()), 0);
  const FileDescriptor mine(ends[0]);
  const FileDescriptor theirs(ends[1]);
  const auto peer = peer_of(mine.get());
  ASSERT_TRUE(peer);
  EXPECT_EQ(peer->user, ::geteuid());
  EXPECT_EQ(peer->group, ::getegid());
}

TEST(Peer, NotASocket_Nullopt) {
  std::array<int, 2> ends{};
  ASSERT_EQ(::pipe(ends.data()), 0);
  const FileDescriptor out(ends[0]);
  const FileDescriptor in(ends[1]);
  EXPECT_FALSE(peer_of(out.get()));
}

}  // namespace
}  // namespace cornerd::daemon
