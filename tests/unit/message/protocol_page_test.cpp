// SPDX-License-Identifier: MIT
// The manual page cornerd-protocol(7) has all of the protocol.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cstdio>
#include <memory>
#include <string>

#include "message/request.hpp"
#include "tests/temporary_folder.hpp"

namespace cornerd::message {
namespace {

using testing::HasSubstr;

std::string output_of(const std::string& command) {
  const std::unique_ptr<FILE, int (*)(FILE*)> pipe(::popen(command.c_str(), "r"), ::pclose);
  std::string text;
  std::array<char, 4096> part{};
  while (const std::size_t size = std::fread(part.data(), 1, part.size(), pipe.get())) {
    text.append(part.data(), size);
  }
  return text;
}

class ProtocolPageTest : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    const test::TemporaryFolder folder;
    const std::string source = CORNERD_SOURCE_DIR;
    const std::string file = (folder / "cornerd-protocol.7.gz").string();
    page_ = output_of(source + "/cmake/man_page " + file + " 1 protocol " + source +
                      "/src/message/protocol.md && gzip -dc " + file);
  }
  static std::string page_;
};
std::string ProtocolPageTest::page_;

TEST_F(ProtocolPageTest, HasEachClass) {
  for (std::size_t i = 0; i < kMessageClasses; ++i) {
    EXPECT_THAT(page_, HasSubstr(std::string(to_string(static_cast<MessageClass>(i)))));
  }
}

TEST_F(ProtocolPageTest, HasEachRequestAndAnswer) {
  for (const std::string name :
       {"WATCH", "POLL", "RELOCALIZE", "SET_POSE", "SET_MAP", "ODOMETRY"}) {
    // One that parse_request takes: it misses fields at most.
    const Request request = parse_request("{\"class\":\"" + name + "\"}");
    const auto* error = std::get_if<RequestError>(&request.body);
    EXPECT_TRUE(error == nullptr || error->code == "field") << name;
    EXPECT_THAT(page_, HasSubstr(".B \"" + name + "\""));
  }
  for (const char* answer : {"OK", "ERROR", "too\\-long", "second\\-client", "read\\-only"}) {
    EXPECT_THAT(page_, HasSubstr(answer));
  }
}

TEST_F(ProtocolPageTest, HasStatesUnitsAndSections) {
  for (const char* words :
       {"tracking", "ambiguous", ".B \"x, y, theta [m, m, rad]\"", ".SH REQUESTS", ".SH EXAMPLES",
        ".SH FILES", "socat", ".SH RECORDINGS"}) {
    EXPECT_THAT(page_, HasSubstr(words));
  }
  EXPECT_THAT(page_, testing::Not(HasSubstr("|")));
}

}  // namespace
}  // namespace cornerd::message
