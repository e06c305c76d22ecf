// SPDX-License-Identifier: MIT
#pragma once

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace cornerd::test {

/// What a user sees of one call of a program: its exit code, standard output and standard error.
struct ProgramRun {
  ProgramRun(const char* name, int (*run)(int, const char* const*),
             const std::vector<std::string>& words) {
    std::vector<const char*> arguments = {name};
    for (const std::string& word : words) arguments.push_back(word.c_str());
    testing::internal::CaptureStdout();
    testing::internal::CaptureStderr();
    exit_code = run(static_cast<int>(arguments.size()), arguments.data());
    out = testing::internal::GetCapturedStdout();
    err = testing::internal::GetCapturedStderr();
  }

  int exit_code = 0;
  std::string out;
  std::string err;
};

}  // namespace cornerd::test
