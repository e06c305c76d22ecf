// SPDX-License-Identifier: MIT
#include "daemon/event_loop.hpp"

#include <gtest/gtest.h>
#include <sys/epoll.h>
#include <sys/eventfd.h>

#include <stdexcept>
#include <system_error>

namespace cornerd::daemon {
namespace {

FileDescriptor readable_fd() { return FileDescriptor(::eventfd(1, EFD_NONBLOCK | EFD_CLOEXEC)); }

TEST(EventLoop, ReadyDescriptor_HandlerCalled) {
  EventLoop loop;
  const FileDescriptor fd = readable_fd();
  int calls = 0;
  loop.add(fd.get(), EPOLLIN, [&](std::uint32_t events) {
    EXPECT_TRUE(events & EPOLLIN);
    ++calls;
  });
  loop.run_once(0);
  EXPECT_EQ(calls, 1);
  loop.change(fd.get(), 0);
  loop.run_once(0);
  EXPECT_EQ(calls, 1);
}

TEST(EventLoop, HandlerRemovesItself_NotCalledAgain) {
  EventLoop loop;
  const FileDescriptor fd = readable_fd();
  int calls = 0;
  loop.add(fd.get(), EPOLLIN, [&, token = std::string(100, 'x')](std::uint32_t) {
    loop.remove(fd.get());
    calls += token.size() == 100 ? 1 : 1000;  // the captures must still exist
  });
  loop.run_once(0);
  loop.run_once(0);
  EXPECT_EQ(calls, 1);
}

TEST(EventLoop, HandlerRemovedInSameRound_NotCalled) {
  EventLoop loop;
  const FileDescriptor first = readable_fd();
  const FileDescriptor second = readable_fd();
  int calls = 0;
  const auto remove_both = [&](std::uint32_t) {
    ++calls;
    loop.remove(first.get());
    loop.remove(second.get());
  };
  loop.add(first.get(), EPOLLIN, remove_both);
  loop.add(second.get(), EPOLLIN, remove_both);
  loop.run_once(0);
  EXPECT_EQ(calls, 1);
}

TEST(EventLoop, DescriptorNumberReusedInSameRound_NoStaleEvent) {
  EventLoop loop;
  const FileDescriptor first = readable_fd();
  const FileDescriptor second = readable_fd();
  int calls = 0;
  // The first handler gives the other's number to a descriptor that is not readable.
  const auto replace = [&](int other) {
    ++calls;
    loop.remove(other);
    const FileDescriptor silent(::eventfd(0, EFD_NONBLOCK | EFD_CLOEXEC));
    ASSERT_EQ(::dup2(silent.get(), other), other);
    loop.add(other, EPOLLIN, [&](std::uint32_t) { calls += 100; });
  };
  loop.add(first.get(), EPOLLIN, [&](std::uint32_t) { replace(second.get()); });
  loop.add(second.get(), EPOLLIN, [&](std::uint32_t) { replace(first.get()); });
  loop.run_once(0);
  EXPECT_EQ(calls, 1);
}

TEST(EventLoop, ChangedEvents_OthersThanBeforeAreReported) {
  constexpr std::uint32_t kNone = 0;
  constexpr std::uint32_t kIn = EPOLLIN;
  constexpr std::uint32_t kOut = EPOLLOUT;
  EventLoop loop;
  const FileDescriptor fd = readable_fd();
  std::uint32_t seen = 0;
  loop.add(fd.get(), EPOLLIN, [&](std::uint32_t events) { seen = events; });
  for (const std::uint32_t events : {kNone, kIn | kOut, kIn, kIn}) {
    loop.change(fd.get(), events);
    seen = 0;
    loop.run_once(0);
    EXPECT_EQ(seen, events);
  }
}

TEST(EventLoop, Stop_Called_EndsRun) {
  EventLoop loop;
  const FileDescriptor fd = readable_fd();
  int calls = 0;
  loop.add(fd.get(), EPOLLIN, [&](std::uint32_t) {
    if (++calls > 1) throw std::logic_error("run() does not end");
    loop.stop();
  });
  loop.run();
  EXPECT_EQ(calls, 1);
}

TEST(EventLoop, InvalidDescriptor_Throws) {
  EventLoop loop;
  EXPECT_THROW(loop.add(-1, EPOLLIN, [](std::uint32_t) {}), std::system_error);
}

}  // namespace
}  // namespace cornerd::daemon
