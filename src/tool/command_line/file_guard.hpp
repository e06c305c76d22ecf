// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <vector>

namespace cornerd::tool {

/// The name that stands for standard output.
inline constexpr const char* kStandardOutput = "-";

/// What a command reads and writes; names that are empty stand for nothing.
struct CommandFiles {
  std::vector<std::filesystem::path> read;
  /// Pictures, ways, recordings: each a file of its own.
  std::vector<std::filesystem::path> written;
  /// What -o names where that may be standard output.
  std::filesystem::path output;
};

/// To be asked before anything is written. Throws UsageError where a file would be written over
/// one that is read or over another output, by whatever names, and where something in `written`
/// is "-".
void guard_files(const CommandFiles& files);

}  // namespace cornerd::tool
