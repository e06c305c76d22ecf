// SPDX-License-Identifier: MIT
#include "mqtt/control_queue.hpp"

#include <gtest/gtest.h>

#include "tests/temporary_folder.hpp"
#include "tests/wait_until.hpp"

namespace cornerd::mqtt {
namespace {

TEST(ControlQueue, NoDaemon_IsAnsweredInDeliver) {
  const test::TemporaryFolder folder;
  ControlQueue queue(folder / "control.sock");
  std::string why;
  ASSERT_TRUE(queue.ask("{}\n", [&](const client::Answer& answer) { why = answer.text; }));
  EXPECT_TRUE(test::wait_until([&] {
    queue.deliver();
    return !why.empty();
  }));
  EXPECT_NE(why.find("control.sock"), std::string::npos) << why;
}

TEST(ControlQueue, Flood_IsRefused) {
  const test::TemporaryFolder folder;
  ControlQueue queue(folder / "control.sock");
  bool is_refused = false;
  // The thread answers each within microseconds, since nobody listens.
  for (int i = 0; i < 100'000 && !is_refused; ++i) {
    is_refused = !queue.ask("{}\n", [](const client::Answer&) {});
  }
  EXPECT_TRUE(is_refused);
}

}  // namespace
}  // namespace cornerd::mqtt
