// SPDX-License-Identifier: MIT
// tests/web reads such files with a reader that is not ours; here are the limits of the format.
#include "foxglove/mcap_writer.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

namespace cornerd::foxglove {
namespace {

constexpr std::string_view kMagic = "\x89MCAP0\r\n";

std::size_t count(const std::string& text, const std::string& part) {
  std::size_t found = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) {
    ++found;
  }
  return found;
}

TEST(McapWriter, EmptyFile_HasBothEnds) {
  std::string file;
  McapWriter writer([&](std::string_view bytes) { file += bytes; });
  writer.finish();
  EXPECT_TRUE(file.starts_with(kMagic));
  EXPECT_TRUE(file.ends_with(kMagic));
  EXPECT_EQ(writer.messages(), 0u);
}

TEST(McapWriter, LongRecording_IsWrittenInChunksWhoseSchemasComeOnce) {
  std::string file;
  McapWriter writer([&](std::string_view bytes) { file += bytes; });
  const std::string text = "{\"a\":\"" + std::string(100'000, 'x') + "\"}";
  std::size_t largest_wait = 0;
  for (int i = 0; i < 50; ++i) {
    const std::size_t before = file.size();
    writer.add(ChannelId::kEventMessage, i, text);
    largest_wait = std::max(largest_wait, file.size() - before);
  }
  EXPECT_GT(file.size(), 4'000'000u) << "nothing is held back but one chunk";
  EXPECT_LT(largest_wait, 1'300'000u);
  writer.finish();
  EXPECT_EQ(writer.messages(), 50u);
  EXPECT_EQ(count(file, "{\"a\":\"x"), 50u);
  // Before its first message, and in the summary.
  EXPECT_EQ(count(file, "cornerd.Event"), 2u);
}

TEST(McapWriter, TimeBeforeZero_IsZero) {
  std::string file;
  McapWriter writer([&](std::string_view bytes) { file += bytes; });
  writer.add(ChannelId::kEventMessage, -5, "{}");
  writer.finish();
  EXPECT_EQ(file.find("\xff\xff\xff\xff"), std::string::npos);
}

}  // namespace
}  // namespace cornerd::foxglove
