// SPDX-License-Identifier: MIT
#pragma once

#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>

namespace cornerd::tool {

/// Standard output or a file, and the one place that notices that writing failed.
class Output {
 public:
  /// Standard output; `flush_each`: for those who read along.
  explicit Output(bool flush_each = false);
  /// A new file. Throws Failure.
  explicit Output(const std::filesystem::path& file);

  /// Throws OutputClosed where the reader has gone, Failure where the disk is full.
  void write(std::string_view bytes);

  /// Brings out what is buffered: the last chance to notice that the disk is full. Throws the same.
  void flush();

 private:
  [[noreturn]] void fail() const;

  struct Closer {
    void operator()(std::FILE* file) const;
  };
  std::unique_ptr<std::FILE, Closer> file_;
  std::string name_;
  bool flush_each_ = false;
};

}  // namespace cornerd::tool
