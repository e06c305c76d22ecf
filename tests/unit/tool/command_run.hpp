// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "tests/program_run.hpp"
#include "tool/cornerctl.hpp"

namespace cornerd::tool {

/// One call of cornerctl with these words.
struct CommandRun : test::ProgramRun {
  explicit CommandRun(const std::vector<std::string>& words)
      : ProgramRun("cornerctl", run_cornerctl, words) {}
};

}  // namespace cornerd::tool
