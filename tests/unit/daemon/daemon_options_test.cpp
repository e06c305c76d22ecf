// SPDX-License-Identifier: MIT
#include "daemon/daemon_options.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sstream>
#include <string>
#include <string_view>
#include <vector>

namespace cornerd::daemon {
namespace {

using ::testing::ElementsAre;

Options parse(const std::vector<const char*>& arguments) { return parse_options(arguments); }

TEST(Options, ValueAfterSpaceOrEquals_Same) {
  EXPECT_EQ(parse({"--config", "a.json"}).config, "a.json");
  EXPECT_EQ(parse({"--config=a.json"}).config, "a.json");
}

TEST(Options, Overrides_KeepOrderAndEqualsSigns) {
  const Options options = parse({"--config=c", "--set", "/a=1", "--set=/b=x=y", "--check"});
  EXPECT_THAT(options.overrides, ElementsAre("/a=1", "/b=x=y"));
  EXPECT_TRUE(options.check);
}

TEST(Options, HelpAndVersion_NoConfigNeeded) {
  EXPECT_TRUE(parse({"--help"}).help);
  EXPECT_TRUE(parse({"--version"}).version);
}

TEST(Options, WrongUsage_Throws) {
  EXPECT_THROW(parse({}), UsageError);
  EXPECT_THROW(parse({"--check"}), UsageError);
  EXPECT_THROW(parse({"--config"}), UsageError);
  EXPECT_THROW(parse({"--config=c", "--check=yes"}), UsageError);
  EXPECT_THROW(parse({"--config=c", "--verbose"}), UsageError);
  EXPECT_THROW(parse({"c.json"}), UsageError);
  for (const char* override : {"x", "/advanced/lidar/baud", "lidar=1", "/=1", ""}) {
    EXPECT_THROW(parse({"--config=c", "--set", override}), UsageError) << override;
  }
}

TEST(Options, Help_Text_NamesEveryOption) {
  for (const char* option : {"--config", "--set", "--check", "--help", "--version"}) {
    EXPECT_NE(kHelp.find(option), std::string_view::npos) << option;
  }
}

TEST(Options, Help_Text_Fits80Columns) {
  std::istringstream lines{std::string(kHelp)};
  for (std::string line; std::getline(lines, line);) EXPECT_LE(line.size(), 80U) << line;
}

}  // namespace
}  // namespace cornerd::daemon
