// SPDX-License-Identifier: MIT
#include "web/http.hpp"

#include <gtest/gtest.h>

namespace cornerd::web {
namespace {

TEST(SetTarget, PathIsDecodedQueryIsNot) {
  Request request;
  ASSERT_TRUE(set_target("/api/maps/my%2Dmap?x=%41&y=2", request));
  EXPECT_EQ(request.path, "/api/maps/my-map");
  EXPECT_EQ(request.query, "x=%41&y=2");
  EXPECT_EQ(query_value(request.query, "x"), "A");
  EXPECT_EQ(query_value(request.query, "y"), "2");
  EXPECT_EQ(query_value(request.query, "z"), "");
}

TEST(SetTarget, MalformedTargets_AreRefused) {
  Request request;
  for (const char* target : {"", "api", "http://127.0.0.1/", "*", "/%", "/%4", "/%zz", "/a%00b"}) {
    EXPECT_FALSE(set_target(target, request)) << target;
  }
}

TEST(ErrorResponse, QuotesAreEscaped) {
  const Response response = error_response(409, "field", "\"x\" is\nmissing");
  EXPECT_EQ(response.status, 409u);
  EXPECT_EQ(response.body,
            "{\"class\":\"ERROR\",\"code\":\"field\",\"message\":\"\\\"x\\\" is\\nmissing\"}\n");
}

}  // namespace
}  // namespace cornerd::web
