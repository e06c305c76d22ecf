// SPDX-License-Identifier: MIT
#include "mqtt/drive_parts.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace cornerd::mqtt {
namespace {

TEST(DriveParts, Drive_IsPutTogetherInAnyOrder) {
  std::string bytes(1'300'000, 'x');
  bytes[700'000] = 'y';
  auto messages = drive_messages("hq", "r-1", "a.ndjson", bytes);
  ASSERT_EQ(messages.size(), 4u);
  std::reverse(messages.begin(), messages.end());
  DriveParts parts("hq", "r-1");
  for (const Message& message : messages) parts.take(message);
  const auto whole = parts.whole();
  ASSERT_EQ(whole.size(), 1u);
  EXPECT_EQ(whole[0].name, "a.ndjson");
  EXPECT_EQ(whole[0].bytes, bytes);
  EXPECT_TRUE(parts.incomplete().empty());
}

TEST(DriveParts, DamagedOrMissingPart_IsNoDrive) {
  for (const bool is_missing : {true, false}) {
    DriveParts parts("hq", "r-1");
    for (Message& message : drive_messages("hq", "r-1", "a", std::string(600'000, 'x'))) {
      if (message.topic.ends_with("/1") && is_missing) continue;
      if (message.topic.ends_with("/1")) message.payload[0] = 'y';
      parts.take(message);
    }
    EXPECT_TRUE(parts.whole().empty());
    EXPECT_EQ(parts.incomplete().size(), 1u);
  }
}

TEST(DriveParts, Garbage_IsIgnored) {
  DriveParts parts("hq", "r-1");
  for (const char* topic :
       {"cornerd/hq/drive/r-1/a", "cornerd/hq/drive/r-1/a/x",
        "cornerd/hq/drive/r-1/a/99999999999999999999", "other", "cornerd/hq/drive/r-1/"}) {
    parts.take({topic, R"({"parts":1e9,"sha256":7})", true});
  }
  EXPECT_TRUE(parts.whole().empty());
}

}  // namespace
}  // namespace cornerd::mqtt
