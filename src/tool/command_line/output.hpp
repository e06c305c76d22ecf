// SPDX-License-Identifier: MIT
#pragma once

#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace cornerd::tool {

/// A file for others to write, beside the one that it takes the place of; that one stays on a
/// failure. Pipes, devices and "" are written themselves.
class Replacement {
 public:
  explicit Replacement(const std::filesystem::path& file);
  ~Replacement();
  Replacement(const Replacement&) = delete;
  Replacement& operator=(const Replacement&) = delete;

  /// With the same ending.
  const std::filesystem::path& path() const { return path_; }
  /// Throws Failure; the file is what is at path() from here on.
  void commit();

 private:
  std::filesystem::path target_;  ///< empty: path_ itself
  std::filesystem::path path_;
};

/// Standard output or a file. Reports every failed write.
class Output {
 public:
  /// Standard output; `flush_each`: after every write.
  explicit Output(bool flush_each = false);
  /// A new file, or standard output if the name is "-". Throws Failure.
  explicit Output(const std::filesystem::path& file);

  /// As Output(file), but a regular file keeps its old content until commit().
  static Output replacing(const std::filesystem::path& file);

  /// Output for the report: standard output, or standard error if `data` is standard output.
  static Output report_beside(const std::filesystem::path& data);

  /// Throws OutputClosed if the reader closed the pipe, Failure if the disk is full.
  void write(std::string_view bytes);

  /// Writes the buffer; a full disk may only be reported here. Throws as write().
  void flush();

  /// Flushes; the file of replacing() is what was written from here on. Throws as write().
  void commit();

 private:
  Output(std::FILE* stream, std::string name, bool flush_each);
  [[noreturn]] void fail() const;

  struct Closer {
    void operator()(std::FILE* file) const;
  };
  std::unique_ptr<std::FILE, Closer> file_;
  std::string name_;
  std::unique_ptr<Replacement> replacement_;  ///< of replacing()
  bool flush_each_ = false;
};

/// Replaces a whole file, or writes standard output for "-". On a failure the old file stays.
/// Throws as Output.
void write_file(const std::filesystem::path& file, std::string_view text);

/// A file that cannot be made again, as a drive's recording, becomes FILE~, or FILE~2 and so on,
/// before another takes its name; says so on standard error. Throws Failure.
void keep_earlier(const std::filesystem::path& file);

/// The name of standard output.
inline constexpr const char* kStandardOutput = "-";

/// Input and output files of a command; empty names are ignored.
struct CommandFiles {
  std::vector<std::filesystem::path> read;
  /// Drawings, trajectories, recordings; not standard output.
  std::vector<std::filesystem::path> written;
  /// The file of -o, if it may be standard output.
  std::filesystem::path output;
};

/// Call before the first write. Throws UsageError if an output is the same file as an input or as
/// another output, links included, or if one of `written` is "-".
void guard_files(const CommandFiles& files);

}  // namespace cornerd::tool
