// SPDX-License-Identifier: MIT
#include "drivers/odometry/sysfs.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <system_error>
#include <vector>

namespace cornerd::drivers {
namespace {

template <typename Number, typename... Format>
std::optional<Number> parse_whole(std::string_view text, Format... format) {
  text = without_newline(text);
  Number value{};
  const char* const end = text.data() + text.size();
  const auto [stopped, error] = std::from_chars(text.data(), end, value, format...);
  if (error != std::errc{} || stopped != end) return std::nullopt;
  return value;
}

}  // namespace

std::string_view without_newline(std::string_view text) {
  if (text.ends_with('\n')) text.remove_suffix(1);
  return text;
}

std::optional<std::int64_t> parse_integer(std::string_view text) {
  return parse_whole<std::int64_t>(text);
}

std::optional<double> parse_decimal(std::string_view text) {
  const auto value = parse_whole<double>(text, std::chars_format::fixed);
  return value && std::isfinite(*value) ? value : std::nullopt;  // from_chars takes "inf" and "nan"
}

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

namespace {

/// Sorted, so that the same tree gives the same answer.
std::vector<std::filesystem::path> folders_in(const std::filesystem::path& devices) {
  std::vector<std::filesystem::path> folders;
  std::error_code error;
  for (std::filesystem::directory_iterator entry(devices, error), end; !error && entry != end;
       entry.increment(error)) {
    folders.push_back(entry->path());
  }
  std::sort(folders.begin(), folders.end());
  return folders;
}

}  // namespace

FoundDevice find_device(const std::filesystem::path& devices, std::string_view name) {
  FoundDevice found;
  std::string others;
  bool is_only_one = true;
  for (const std::filesystem::path& folder : folders_in(devices)) {
    const auto its_name = read_attribute(folder / "name");
    if (!its_name) continue;
    if (*its_name == name || read_attribute(folder / "label") == name) {
      is_only_one = found.folder.empty();
      found.folder = folder;
    } else {
      others.append(others.empty() ? "" : ", ").append(*its_name);
    }
  }
  if (!is_only_one) {
    found.folder.clear();
    found.problem.append("several devices in ")
        .append(devices.string())
        .append(" are named ")
        .append(name)
        .append("; give each its own label");
  } else if (found.folder.empty()) {
    found.problem.append("no device in ")
        .append(devices.string())
        .append(" is named ")
        .append(name);
    if (!others.empty()) found.problem.append("; set one of: ").append(others);
  }
  return found;
}

}  // namespace cornerd::drivers
