// SPDX-License-Identifier: MIT
#include "tool/output.hpp"

#include <cerrno>
#include <cstring>

#include "tool/failure.hpp"

namespace cornerd::tool {

void Output::Closer::operator()(std::FILE* file) const {
  if (file != stdout) std::fclose(file);
}

Output::Output(bool flush_each)
    : file_(stdout), name_("standard output"), flush_each_(flush_each) {}

Output::Output(const std::filesystem::path& file)
    : file_(std::fopen(file.c_str(), "wbe")), name_(file.string()) {
  if (!file_) fail();
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
