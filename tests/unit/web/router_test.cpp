// SPDX-License-Identifier: MIT
#include "web/router.hpp"

#include <gtest/gtest.h>

#include "web/page.hpp"

namespace cornerd::web {
namespace {

class RouterTest : public ::testing::Test {
 protected:
  Request request(const std::string& method, const std::string& path) const {
    Request one;
    one.method = method;
    one.path = path;
    one.host = "127.0.0.1:8088";
    one.content_type = "application/json";
    one.from_loopback = true;
    return one;
  }
  unsigned refusal(const Request& one) const {
    const Router::Decision decision = router_.decide(one);
    return decision.kind == Router::Kind::kRefused ? decision.response.status : 0;
  }

  Hub hub_;
  Router router_{{}, "/nowhere/control.sock", {}, hub_};
};

TEST_F(RouterTest, EachPath_TakesItsMethodAlone) {
  for (const char* path : {"/", "/app.js", "/api/map", "/api/status", "/api/events",
                           "/api/recording", "/api/maps", "/metrics", "/foxglove"}) {
    EXPECT_EQ(refusal(request("GET", path)), 0u) << path;
    EXPECT_EQ(refusal(request("POST", path)), 405u) << path;
  }
  EXPECT_EQ(refusal(request("POST", "/api/request")), 0u);
  EXPECT_EQ(refusal(request("GET", "/api/request")), 405u);
  EXPECT_EQ(refusal(request("PUT", "/api/maps/hall")), 0u);
  EXPECT_EQ(refusal(request("GET", "/../etc/passwd")), 404u);
}

TEST_F(RouterTest, EventsOfAnUnknownClass_AreRefused) {
  Request one = request("GET", "/api/events");
  one.query = "classes=POSE,SCAN";
  EXPECT_EQ(refusal(one), 0u);
  one.query = "classes=POSE,pose";
  EXPECT_EQ(refusal(one), 400u);
}

TEST_F(RouterTest, ForeignPages_AreRefused) {
  Request one = request("GET", "/");
  one.host = "evil.com";
  EXPECT_EQ(refusal(one), 403u);
  one = request("POST", "/api/request");
  one.origin = "http://evil.com";
  EXPECT_EQ(refusal(one), 403u);
}

TEST_F(RouterTest, Preflight_IsForAllowedOrigins) {
  const Router router({.own_name = {},
                       .token = "0123456789abcdef",
                       .allowed_origins = {"https://app.example.org"},
                       .is_private = true},
                      "/nowhere/control.sock", {}, hub_);
  Request one = request("OPTIONS", "/api/request");
  EXPECT_EQ(router.decide(one).response.status, 405u);
  one.origin = "https://app.example.org";
  EXPECT_EQ(router.decide(one).response.status, 204u);
  one.origin = "http://evil.com";
  EXPECT_EQ(router.decide(one).response.status, 403u);
}

TEST_F(RouterTest, MapNamedCheck_IsAMapAsOthers) {
  Request one = request("PUT", "/api/maps/check");
  EXPECT_EQ(refusal(one), 0u);
  EXPECT_EQ(router_.work(one).status, 404u);  // without --maps
  one.method = "POST";
  EXPECT_EQ(router_.work(one).status, 422u);
}

TEST_F(RouterTest, Change_NeedsJsonAndPermission) {
  Request one = request("POST", "/api/request");
  one.content_type = "text/plain";
  EXPECT_EQ(refusal(one), 415u);
  one = request("POST", "/api/request");
  one.from_loopback = false;
  EXPECT_EQ(refusal(one), 403u);
}

TEST_F(RouterTest, NoDaemon_IsUnavailable) {
  EXPECT_EQ(router_.answer(request("GET", "/api/map"), {}).status, 503u);
  Request one = request("POST", "/api/request");
  one.body = "{\"class\":\"RELOCALIZE\"}";
  EXPECT_EQ(router_.work(one).status, 503u);
  one.body = "{\"class\":\"NOPE\"}";
  EXPECT_EQ(router_.work(one).status, 409u);
}

TEST_F(RouterTest, Recording_TakesOneToSixtySeconds) {
  for (const char* query : {"seconds=0", "seconds=61", "seconds=x", "seconds=5x"}) {
    Request one = request("GET", "/api/recording");
    one.query = query;
    EXPECT_EQ(router_.answer(one, {}).status, 400u) << query;
  }
  EXPECT_EQ(router_.answer(request("GET", "/api/recording"), {}).status, 200u);
}

TEST_F(RouterTest, Recordings_AreTwoAtATime) {
  const Request one = request("GET", "/api/recording");
  const Response first = router_.answer(one, {});
  {
    const Response second = router_.answer(one, {});
    EXPECT_EQ(second.status, 200u);
    EXPECT_EQ(router_.answer(one, {}).status, 503u);
  }
  EXPECT_EQ(router_.answer(one, {}).status, 200u);
}

TEST_F(RouterTest, Page_AsksNobodyElseAndIsSmall) {
  std::size_t bytes = 0;
  for (const PageFile& file : page_files()) {
    bytes += file.content.size();
    EXPECT_EQ(file.content.find("http://"), std::string_view::npos) << file.path;
    EXPECT_EQ(file.content.find("https://"), std::string_view::npos) << file.path;
  }
  EXPECT_LT(bytes, 150'000u);
  EXPECT_NE(router_.answer(request("GET", "/"), {}).body.find("id=\"map\""), std::string::npos);
}

}  // namespace
}  // namespace cornerd::web
