// SPDX-License-Identifier: MIT
#include "drivers/odometry/attribute.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>

#include "drivers/odometry/attribute_text.hpp"

namespace cornerd::drivers {

int Attribute::open(const std::filesystem::path& file) {
  file_ = file.string();
  fd_ = FileDescriptor(::open(file_.c_str(), O_RDONLY | O_CLOEXEC));
  return fd_.is_open() ? 0 : errno;
}

bool Attribute::is_current() const {
  struct stat named {};
  struct stat opened {};
  return fd_.is_open() && ::stat(file_.c_str(), &named) == 0 && ::fstat(fd_.get(), &opened) == 0 &&
         named.st_ino == opened.st_ino && named.st_dev == opened.st_dev;
}

Attribute::Reading Attribute::read() {
  if (!fd_.is_open()) return {.error = ENODEV, .text = {}};
  const ssize_t bytes = ::pread(fd_.get(), text_.data(), text_.size(), 0);
  if (bytes < 0) return {.error = errno, .text = {}};
  return {.error = 0, .text = {text_.data(), static_cast<std::size_t>(bytes)}};
}

std::optional<std::string> read_attribute(const std::filesystem::path& file) {
  Attribute attribute;
  if (attribute.open(file) != 0) return std::nullopt;
  const Attribute::Reading reading = attribute.read();
  if (reading.error != 0) return std::nullopt;
  return std::string(without_newline(reading.text));
}

}  // namespace cornerd::drivers
