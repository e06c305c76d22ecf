// SPDX-License-Identifier: MIT
#include "tool/command_line/output.hpp"

#include <cerrno>
#include <cstring>
#include <utility>

#include "tool/command_line/failure.hpp"
#include "tool/command_line/file_guard.hpp"

namespace cornerd::tool {

void Output::Closer::operator()(std::FILE* file) const {
  if (file != stdout && file != stderr) std::fclose(file);
}

Output::Output(std::FILE* stream, std::string name, bool flush_each)
    : file_(stream), name_(std::move(name)), flush_each_(flush_each) {}

Output::Output(bool flush_each) : Output(stdout, "standard output", flush_each) {}

Output::Output(const std::filesystem::path& file)
    : Output(file == kStandardOutput ? stdout : std::fopen(file.c_str(), "wbe"), file.string(),
             false) {
  if (!file_) fail();
}

Output Output::report_beside(const std::filesystem::path& data) {
  if (data == kStandardOutput) return {stderr, "standard error", false};
  return Output();
}

void Output::write(std::string_view bytes) {
  if (std::fwrite(bytes.data(), 1, bytes.size(), file_.get()) != bytes.size()) fail();
  if (flush_each_) flush();
}

void Output::flush() {
  if (std::fflush(file_.get()) != 0) fail();
}

void Output::fail() const {
  if (errno == EPIPE) throw OutputClosed();
  throw Failure(name_ + ": " + std::strerror(errno));
}

}  // namespace cornerd::tool
