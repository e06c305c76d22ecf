// SPDX-License-Identifier: MIT
#include "daemon/outbox.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <string>
#include <string_view>

namespace cornerd::daemon {
namespace {

using message::MessageClass;
using Result = Outbox::Result;

/// A socket whose buffer the test controls.
class Pipe {
 public:
  explicit Pipe(std::size_t room) : room_(room) {}

  Outbox::Write writer() {
    return [this](std::string_view bytes) -> std::ptrdiff_t {
      if (broken_) return -1;
      const std::size_t taken = std::min(bytes.size(), room_);
      received_ += bytes.substr(0, taken);
      room_ -= taken;
      return static_cast<std::ptrdiff_t>(taken);
    };
  }
  void evict_pose_client(std::size_t bytes) { room_ += bytes; }
  void break_off() { broken_ = true; }
  const std::string& received() const { return received_; }

 private:
  std::size_t room_;
  bool broken_ = false;
  std::string received_;
};

Line line_of(std::string_view text) { return std::make_shared<const std::string>(text); }

TEST(Outbox, ReadingClient_AllLinesInOrder) {
  Outbox outbox;
  Pipe pipe(1000);
  outbox.put(MessageClass::kScan, line_of("{\"s\":1}\n"));
  outbox.put(MessageClass::kPose, line_of("{\"p\":1}\n"));
  outbox.answer("{\"a\":1}\n");
  EXPECT_EQ(outbox.flush(pipe.writer()), Result::kEmpty);
  EXPECT_EQ(pipe.received(), "{\"a\":1}\n{\"s\":1}\n{\"p\":1}\n");
  EXPECT_EQ(outbox.dropped(), 0u);
}

TEST(Outbox, SlowClient_NewestLineAndNumberDropped) {
  Outbox outbox;
  Pipe pipe(0);
  for (const char* line : {"{\"p\":1}\n", "{\"p\":2}\n", "{\"p\":3}\n"}) {
    outbox.put(MessageClass::kPose, line_of(line));
    EXPECT_EQ(outbox.flush(pipe.writer()), Result::kBlocked);
  }
  outbox.put(MessageClass::kStatus, line_of("{\"s\":1}\n"));
  pipe.evict_pose_client(1000);
  EXPECT_EQ(outbox.flush(pipe.writer()), Result::kEmpty);
  EXPECT_EQ(pipe.received(), "{\"p\":3,\"dropped\":2}\n{\"s\":1}\n");
  EXPECT_EQ(outbox.dropped(), 2u);
}

TEST(Outbox, DroppedReported_CountRestarts) {
  Outbox outbox;
  Pipe pipe(0);
  outbox.put(MessageClass::kPose, line_of("{\"p\":1}\n"));
  outbox.put(MessageClass::kPose, line_of("{\"p\":2}\n"));
  pipe.evict_pose_client(1000);
  ASSERT_EQ(outbox.flush(pipe.writer()), Result::kEmpty);
  outbox.put(MessageClass::kPose, line_of("{\"p\":3}\n"));
  ASSERT_EQ(outbox.flush(pipe.writer()), Result::kEmpty);
  EXPECT_EQ(pipe.received(), "{\"p\":2,\"dropped\":1}\n{\"p\":3}\n");
}

TEST(Outbox, PartlyWrittenLine_FinishedFirst) {
  Outbox outbox;
  Pipe pipe(3);
  outbox.put(MessageClass::kPose, line_of("{\"p\":1}\n"));
  EXPECT_EQ(outbox.flush(pipe.writer()), Result::kBlocked);
  outbox.answer("{\"a\":1}\n");
  outbox.put(MessageClass::kPose, line_of("{\"p\":2}\n"));
  outbox.put(MessageClass::kPose, line_of("{\"p\":3}\n"));
  while (outbox.flush(pipe.writer()) == Result::kBlocked) pipe.evict_pose_client(1);
  EXPECT_EQ(pipe.received(), "{\"p\":1}\n{\"a\":1}\n{\"p\":3,\"dropped\":1}\n");
}

TEST(Outbox, Answers_BlockedClient_NeverLost) {
  Outbox outbox;
  Pipe pipe(0);
  std::string all;
  for (int i = 0; i < 100; ++i) {
    const std::string line = "{\"id\":" + std::to_string(i) + "}\n";
    all += line;
    outbox.answer(line);
    EXPECT_EQ(outbox.flush(pipe.writer()), Result::kBlocked);
  }
  EXPECT_EQ(outbox.waiting_answers(), 100u);
  pipe.evict_pose_client(100'000);
  EXPECT_EQ(outbox.flush(pipe.writer()), Result::kEmpty);
  EXPECT_EQ(pipe.received(), all);
}

TEST(Outbox, BrokenConnection_Reported) {
  Outbox outbox;
  Pipe pipe(1000);
  pipe.break_off();
  EXPECT_EQ(outbox.flush(pipe.writer()), Result::kEmpty) << "not noticed without a line to write";
  outbox.answer("{}\n");
  EXPECT_EQ(outbox.flush(pipe.writer()), Result::kBroken);
}

}  // namespace
}  // namespace cornerd::daemon
