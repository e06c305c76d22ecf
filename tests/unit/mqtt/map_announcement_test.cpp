// SPDX-License-Identifier: MIT
#include "mqtt/map_announcement.hpp"

#include <gtest/gtest.h>

namespace cornerd::mqtt {
namespace {

const std::string kHash(64, 'a');

TEST(MapAnnouncement, Written_IsReadBack) {
  const MapAnnouncement announcement{"hall", 9007199254740991, kHash, 123};
  const auto read = parse_map_announcement(map_announcement_json(announcement));
  ASSERT_TRUE(read);
  EXPECT_EQ(read->map, "hall");
  EXPECT_EQ(read->version, 9007199254740991u);
  EXPECT_EQ(read->bytes, 123u);
  EXPECT_EQ(map_file_topic("hq", *read), "cornerd/hq/map/hall/" + kHash);
}

TEST(MapAnnouncement, Wrong_IsNone) {
  const auto text = [](const std::string& map, const std::string& version, const std::string& hash,
                       const std::string& bytes) {
    return R"({"map":)" + map + R"(,"version":)" + version + R"(,"sha256":)" + hash +
           R"(,"bytes":)" + bytes + "}";
  };
  const std::string hash = "\"" + kHash + "\"";
  EXPECT_TRUE(parse_map_announcement(text("\"m\"", "1", hash, "1")));
  for (const std::string& wrong :
       {text("\"a/b\"", "1", hash, "1"), text("1", "1", hash, "1"), text("\"m\"", "0", hash, "1"),
        text("\"m\"", "-1", hash, "1"), text("\"m\"", "1.5", hash, "1"),
        text("\"m\"", "\"1\"", hash, "1"), text("\"m\"", "1e300", hash, "1"),
        text("\"m\"", "1", "\"abc\"", "1"), text("\"m\"", "1", "\"../../../etc\"", "1"),
        text("\"m\"", "1", hash, "0"), text("\"m\"", "1", hash, "1e12"), std::string(),
        std::string("{}")}) {
    EXPECT_FALSE(parse_map_announcement(wrong)) << wrong;
  }
}

}  // namespace
}  // namespace cornerd::mqtt
