// SPDX-License-Identifier: MIT
// The Python module against a server in the hands of the test.
#include <gtest/gtest.h>

#include <array>
#include <cstdio>
#include <string>

#include "line_server.hpp"
#include "tests/temporary_folder.hpp"

namespace cornerd::client {
namespace {

struct PythonClient : ::testing::Test {
  test::TemporaryFolder folder;
  LineServer server{folder / "s"};

  void SetUp() override {
    if (std::system("command -v python3 >/dev/null") != 0) GTEST_SKIP() << "no python3";
  }
  /// Starts a script; `path` is the socket.
  std::FILE* start(const std::string& script) const {
    const std::string command = "PYTHONDONTWRITEBYTECODE=1 PYTHONPATH=" CORNERD_SOURCE_DIR
                                "/src/client python3 -c 'import cornerd; path = \"" +
                                (folder / "s").string() + "\"\n" + script + "' 2>&1";
    return ::popen(command.c_str(), "r");
  }
  static std::string output_of(std::FILE* script) {
    std::string text;
    std::array<char, 256> chunk{};
    while (std::fgets(chunk.data(), chunk.size(), script) != nullptr) text += chunk.data();
    ::pclose(script);
    return text;
  }
};

TEST_F(PythonClient, Messages_ComeAcrossARestart) {
  std::FILE* const script = start(R"(
for message in cornerd.messages(path, classes=["POSE"]):
  print(message["seq"])
  if message["seq"] == 2: break)");
  for (int seq = 1; seq <= 2; ++seq) {
    ASSERT_TRUE(server.accept());
    EXPECT_EQ(server.read_line(), "{\"class\":\"WATCH\",\"classes\":[\"POSE\"]}\n");
    server.write("{\"class\":\"POSE\",\"seq\":" + std::to_string(seq) + "}\n{\"class\":\"PO");
    server.hang_up();
  }
  EXPECT_EQ(output_of(script), "1\n2\n");
}

TEST_F(PythonClient, RefusedRequest_Raises) {
  std::FILE* const script = start(R"(
try: cornerd.request({"class": "FLY"}, path)
except cornerd.RequestError as error: print(error.code, error))");
  ASSERT_TRUE(server.accept());
  EXPECT_EQ(server.read_line(), "{\"class\":\"FLY\"}\n");
  server.write(
      "{\"class\":\"VERSION\"}\n{\"class\":\"ERROR\",\"code\":\"class\",\"message\":\"no\"}\n");
  EXPECT_EQ(output_of(script), "class no\n");
}

}  // namespace
}  // namespace cornerd::client
