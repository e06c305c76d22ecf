// SPDX-License-Identifier: MIT
#include "tool/command_line/file_guard.hpp"

#include <system_error>

#include "tool/command_line/failure.hpp"

namespace cornerd::tool {

namespace {

namespace fs = std::filesystem;

/// Whether or not it exists yet.
bool is_same_file(const fs::path& one, const fs::path& other) {
  if (one.empty() || other.empty()) return false;
  std::error_code ignored;
  return fs::equivalent(one, other, ignored) ||
         fs::weakly_canonical(fs::absolute(one, ignored), ignored) ==
             fs::weakly_canonical(fs::absolute(other, ignored), ignored);
}

/// As /dev/null, which keeps nothing that could be written over.
bool is_device(const fs::path& file) {
  std::error_code ignored;
  return fs::is_character_file(file, ignored);
}

}  // namespace

void guard_files(const CommandFiles& files) {
  for (const fs::path& file : files.written) {
    if (file == kStandardOutput) {
      throw UsageError("-: this output needs a file; one called so is ./-");
    }
  }
  std::vector<fs::path> written = files.written;
  if (files.output != kStandardOutput) written.push_back(files.output);
  for (std::size_t i = 0; i < written.size(); ++i) {
    for (const fs::path& file : files.read) {
      if (is_same_file(file, written[i])) {
        throw UsageError(written[i].string() + ": would be written over what is read");
      }
    }
    for (std::size_t j = 0; j < i; ++j) {
      if (is_same_file(written[i], written[j]) && !is_device(written[i])) {
        throw UsageError(written[i].string() + ": would be two of the outputs");
      }
    }
  }
}

}  // namespace cornerd::tool
