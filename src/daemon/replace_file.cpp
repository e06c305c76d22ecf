// SPDX-License-Identifier: MIT
#include "daemon/replace_file.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <string>
#include <system_error>

#include "daemon/require_fd.hpp"

namespace cornerd::daemon {
namespace {

bool write_all(int fd, std::string_view text) {
  while (!text.empty()) {
    const ssize_t count = ::write(fd, text.data(), text.size());
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) return false;
    text.remove_prefix(static_cast<std::size_t>(count));
  }
  return true;
}

}  // namespace

void replace_file(const std::filesystem::path& file, std::string_view text) {
  const std::string fresh = file.string() + ".new";
  const FileDescriptor fd(::open(fresh.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666));
  // fsync() before rename(): otherwise a power cut may leave an empty file.
  if (!fd.is_open() || !write_all(fd.get(), text) || ::fsync(fd.get()) != 0 ||
      ::rename(fresh.c_str(), file.c_str()) != 0) {
    const std::system_error error(errno, std::generic_category(), fresh);
    if (fd.is_open()) ::unlink(fresh.c_str());
    throw error;
  }
  const std::filesystem::path folder = file.has_parent_path() ? file.parent_path() : ".";
  const FileDescriptor name(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  if (name.is_open()) ::fsync(name.get());
}

}  // namespace cornerd::daemon
