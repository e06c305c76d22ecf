// SPDX-License-Identifier: MIT
#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <sstream>
#include <string>
#include <vector>

#include "command_run.hpp"
#include "tool/command_line/failure.hpp"
#include "tool/cornerctl.hpp"

namespace cornerd::tool {
namespace {

TEST(CornerctlUsage, Help_WrapsAt80Columns) {
  for (const std::vector<std::string>& command : {std::vector<std::string>{},
                                                  {"simulate"},
                                                  {"emulate"},
                                                  {"replay"},
                                                  {"calibrate", "noise"},
                                                  {"calibrate", "mount"},
                                                  {"map", "import"},
                                                  {"survey"},
                                                  {"doctor"}}) {
    std::vector<std::string> words = command;
    words.emplace_back("--help");
    std::istringstream lines(CommandRun(words).out);
    for (std::string line; std::getline(lines, line);) EXPECT_LE(line.size(), 80u) << line;
  }
}

TEST(CornerctlUsage, HelpThatCannotBeWritten_Fails) {
  const pid_t child = ::fork();
  if (child == 0) {
    ::dup2(::open("/dev/full", O_WRONLY | O_CLOEXEC), STDOUT_FILENO);
    const char* const words[] = {"cornerctl", "--help"};
    ::_exit(run_cornerctl(2, words));
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  EXPECT_EQ(WEXITSTATUS(status), kExitFailed);
}

TEST(CornerctlUsage, GroupWithoutCommand_NamesItsCommands) {
  const CommandRun run({"calibrate"});
  EXPECT_EQ(run.exit_code, kExitUsage);
  EXPECT_NE(run.err.find("noise, bias, mount, odometry"), std::string::npos) << run.err;
}

TEST(CornerctlUsage, OptionThatMustBePositive_SaysSo) {
  for (const std::string value : {"X", "0", "-1"}) {
    const CommandRun run({"map", "import", "plan.svg", "--scale", value, "-o", "map.json"});
    EXPECT_EQ(run.exit_code, kExitUsage);
    EXPECT_NE(run.err.find("--scale: must be a number above 0, not " + value), std::string::npos)
        << run.err;
  }
}

}  // namespace
}  // namespace cornerd::tool
