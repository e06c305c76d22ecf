// SPDX-License-Identifier: MIT
#include "web/access.hpp"

#include <gtest/gtest.h>

namespace cornerd::web {
namespace {

TEST(AllowedHost, AddressesAndNamesOfThisMachine) {
  for (const char* host :
       {"127.0.0.1", "127.0.0.1:8088", "192.168.1.20:80", "[::1]:8088", "[fe80::1]", "localhost",
        "LocalHost:8088", "robot.local", "robot.local.:80", "beagle"}) {
    EXPECT_TRUE(is_allowed_host(host, "Beagle")) << host;
  }
}

TEST(AllowedHost, NamesThatAnAttackerMayPointHere_AreRefused) {
  for (const char* host :
       {"", "evil.com", "evil.com:8088", "127.0.0.1.evil.com", "localhost.evil.com",
        "beagle.evil.com", "127.0.0.1:", "127.0.0.1:x", "[::1", "[::1]8088", "[evil.com]",
        "robot.local@evil.com", "a b.local"}) {
    EXPECT_FALSE(is_allowed_host(host, "beagle")) << host;
  }
}

TEST(AllowedOrigin, NoneOwnAndListed) {
  const std::vector<std::string> listed{"https://app.example.org"};
  EXPECT_TRUE(is_allowed_origin("", "127.0.0.1:8088", listed));
  EXPECT_TRUE(is_allowed_origin("http://127.0.0.1:8088", "127.0.0.1:8088", listed));
  EXPECT_TRUE(is_allowed_origin("https://APP.example.org", "127.0.0.1:8088", listed));
  EXPECT_FALSE(is_allowed_origin("http://evil.com", "127.0.0.1:8088", listed));
  EXPECT_FALSE(is_allowed_origin("null", "127.0.0.1:8088", listed));
  EXPECT_FALSE(is_allowed_origin("http://127.0.0.1:80", "127.0.0.1:8088", listed));
}

TEST(MayChange, ByTokenOrFromThisMachine) {
  Request request;
  AccessRules rules;
  EXPECT_FALSE(may_change(request, rules));
  request.from_loopback = true;
  EXPECT_TRUE(may_change(request, rules));
  rules.token = "0123456789abcdef";
  EXPECT_FALSE(may_change(request, rules));
  request.authorization = "Bearer 0123456789abcdef";
  EXPECT_TRUE(may_change(request, rules));
  request.authorization = "Bearer 0123456789abcdeF";
  EXPECT_FALSE(may_change(request, rules));
  request.authorization.clear();
  request.query = "a=1&token=0123456789abcdef";
  EXPECT_TRUE(may_change(request, rules));
}

TEST(MayRead, AnybodyUnlessPrivate) {
  Request request;
  request.from_loopback = true;
  AccessRules rules;
  rules.token = "0123456789abcdef";
  EXPECT_TRUE(may_read(request, rules));
  rules.is_private = true;
  EXPECT_FALSE(may_read(request, rules));
  request.query = "token=0123456789abcdef";
  EXPECT_TRUE(may_read(request, rules));
}

TEST(Origin, SchemeHostAndPort_AndNoMore) {
  for (const char* origin : {"https://app.example.org", "http://127.0.0.1:8080", "http://[::1]:80",
                             "http://[::1]", "capacitor://localhost"}) {
    EXPECT_TRUE(is_origin(origin)) << origin;
  }
  for (const char* text : {"", "foo", "app.example.org", "https://", "https://a/", "https://a/b",
                           "https://a:x", "https://a b", "*", "null", "https://*.a", "://a"}) {
    EXPECT_FALSE(is_origin(text)) << text;
  }
}

}  // namespace
}  // namespace cornerd::web
