// SPDX-License-Identifier: MIT
#pragma once

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "tool/cornerctl.hpp"

namespace cornerd::tool {

/// What a user sees of one call of cornerctl.
struct CommandRun {
  explicit CommandRun(const std::vector<std::string>& words) {
    std::vector<const char*> arguments = {"cornerctl"};
    for (const std::string& word : words) arguments.push_back(word.c_str());
    testing::internal::CaptureStdout();
    testing::internal::CaptureStderr();
    exit_code = run_cornerctl(static_cast<int>(arguments.size()), arguments.data());
    out = testing::internal::GetCapturedStdout();
    err = testing::internal::GetCapturedStderr();
  }

  int exit_code = 0;
  std::string out;
  std::string err;
};

}  // namespace cornerd::tool
