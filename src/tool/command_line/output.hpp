// SPDX-License-Identifier: MIT
#pragma once

#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace cornerd::tool {

/// Standard output or a file, and the one place that notices that writing failed.
class Output {
 public:
  /// Standard output; `flush_each`: after every write.
  explicit Output(bool flush_each = false);
  /// A new file, or standard output where it is called "-". Throws Failure.
  explicit Output(const std::filesystem::path& file);

  /// For people: standard output, or standard error where `data` is standard output.
  static Output report_beside(const std::filesystem::path& data);

  /// Throws OutputClosed where the reader has gone, Failure where the disk is full.
  void write(std::string_view bytes);

  /// Brings out what is buffered: the last chance to notice that the disk is full. Throws the same.
  void flush();

 private:
  Output(std::FILE* stream, std::string name, bool flush_each);
  [[noreturn]] void fail() const;

  struct Closer {
    void operator()(std::FILE* file) const;
  };
  std::unique_ptr<std::FILE, Closer> file_;
  std::string name_;
  bool flush_each_ = false;
};

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
