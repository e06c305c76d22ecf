// SPDX-License-Identifier: MIT
#include "daemon/client.hpp"

#include <gtest/gtest.h>
#include <sys/epoll.h>
#include <sys/socket.h>

#include <algorithm>
#include <string>

namespace cornerd::daemon {
namespace {

TEST(Client, ManyRequestsAtOnce_HandledAsAnswersFindRoom) {
  int ends[2];
  ASSERT_EQ(::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends), 0);
  Client client{FileDescriptor(ends[0]), {}};
  const FileDescriptor peer(ends[1]);
  constexpr std::size_t kRequests = 1000;
  std::string requests;
  for (std::size_t i = 0; i < kRequests; ++i) requests += "ask\n";
  ASSERT_EQ(::send(peer.get(), requests.data(), requests.size(), 0),
            static_cast<ssize_t>(requests.size()));

  std::size_t handled = 0;
  const auto handle = [&](std::string_view line) {
    EXPECT_EQ(line, "ask");
    ++handled;
    for (int i = 0; i < 3; ++i) client.outbox().answer(std::string(2000, 'a') + "\n");
  };
  EXPECT_EQ(client.receive(handle), Client::Input::kOpen);
  std::size_t most = 0;
  char block[4096];
  while (true) {
    most = std::max(most, client.outbox().waiting_answers());
    ASSERT_TRUE(client.send());
    if (client.is_blocked()) {
      EXPECT_EQ(client.wanted_events() & EPOLLIN, client.has_requests() ? 0u : EPOLLIN);
      EXPECT_NE(client.wanted_events() & EPOLLOUT, 0u);
      ASSERT_GT(::recv(peer.get(), block, sizeof(block), 0), 0);
    } else if (client.has_requests()) {
      EXPECT_EQ(client.wanted_events(), static_cast<std::uint32_t>(EPOLLOUT)) << "work is left";
      EXPECT_EQ(client.handle_requests(handle), Client::Input::kOpen);
    } else {
      break;
    }
  }
  EXPECT_EQ(handled, kRequests);
  EXPECT_LT(most, 20u);
  EXPECT_EQ(client.wanted_events(), static_cast<std::uint32_t>(EPOLLIN));
}

}  // namespace
}  // namespace cornerd::daemon
