// SPDX-License-Identifier: MIT
#include "tool/doctor/machine.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>

namespace cornerd::tool {

namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMaxFileBytes = std::size_t{4} << 20;
constexpr int kMaxLinks = 32;

}  // namespace

fs::path Machine::outside(const fs::path& inside) const { return root_ / inside.relative_path(); }

fs::path Machine::resolve(const fs::path& file) const { return follow(file, nullptr); }

std::vector<fs::path> Machine::steps(const fs::path& file) const {
  std::vector<fs::path> steps;
  follow(file, &steps);
  return steps;
}

fs::path Machine::follow(const fs::path& file, std::vector<fs::path>* steps) const {
  fs::path done = "/";
  fs::path rest = file.relative_path();
  for (int links = 0; !rest.empty();) {
    const fs::path part = *rest.begin();
    fs::path tail;
    for (auto next = std::next(rest.begin()); next != rest.end(); ++next) tail /= *next;
    rest = tail;
    if (part == "..") {
      done = done.parent_path();
      continue;
    }
    if (part == "." || part.empty()) continue;
    if (steps != nullptr) steps->push_back(done / part);
    const std::string target = read_link(done / part);
    if (target.empty() || ++links > kMaxLinks) {
      done /= part;
      continue;
    }
    if (fs::path(target).is_absolute()) done = "/";
    rest = fs::path(target).relative_path() / rest;
  }
  return done;
}

bool Machine::exists(const fs::path& file) const { return facts(file).has_value(); }

std::optional<FileFacts> Machine::facts(const fs::path& file) const {
  // stat() fails with EOVERFLOW on 32-bit boards if a number of the file needs 64 bits.
  struct statx found {};
  const fs::path target = resolve(file);
  if (::statx(AT_FDCWD, outside(target).c_str(), 0, STATX_BASIC_STATS, &found) != 0) {
    return std::nullopt;
  }
  mode_t mode = found.stx_mode;
  if (files_are_devices_ && S_ISREG(mode) && target.native().starts_with("/dev/")) {
    mode = (mode & ~static_cast<mode_t>(S_IFMT)) | S_IFCHR;
  }
  return FileFacts{found.stx_uid,        found.stx_gid,       mode,
                   found.stx_dev_major,  found.stx_dev_minor, found.stx_ino,
                   found.stx_rdev_major, found.stx_rdev_minor};
}

std::optional<std::string> Machine::read(const fs::path& file) const {
  // Non-blocking: a read at the end of /dev/kmsg would wait.
  const int fd =
      ::open(outside(resolve(file)).c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC | O_NOCTTY);
  if (fd < 0) return std::nullopt;
  std::optional<std::string> text = std::string();
  while (text->size() < kMaxFileBytes) {
    char chunk[8192];
    const ssize_t got = ::read(fd, chunk, sizeof chunk);
    // EPIPE: /dev/kmsg has overwritten the next lines; later ones follow.
    if (got < 0 && (errno == EINTR || errno == EPIPE)) continue;
    if (got < 0 && errno != EAGAIN && text->empty()) text.reset();
    if (got <= 0) break;
    text->append(chunk, static_cast<std::size_t>(got));
  }
  ::close(fd);
  return text;
}

std::string Machine::read_line(const fs::path& file) const {
  const std::optional<std::string> text = read(file);
  return text ? text->substr(0, text->find('\n')) : std::string();
}

std::string Machine::read_link(const fs::path& link) const {
  std::error_code error;
  const fs::path target = fs::read_symlink(outside(link), error);
  return error ? std::string() : target.string();
}

std::vector<std::string> Machine::list(const fs::path& folder) const {
  std::vector<std::string> names;
  std::error_code error;
  fs::directory_iterator entries(outside(resolve(folder)), error);
  // An entry that vanishes meanwhile, such as a process, may end the list early.
  for (; !error && entries != fs::directory_iterator(); entries.increment(error)) {
    names.push_back(entries->path().filename().string());
  }
  std::sort(names.begin(), names.end());
  return names;
}

bool Machine::may_list(const fs::path& folder) const {
  return ::access(outside(resolve(folder)).c_str(), R_OK | X_OK) == 0;
}

std::vector<std::string_view> split_words(std::string_view text, std::string_view separators) {
  std::vector<std::string_view> words;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find_first_of(separators, begin), text.size());
    if (end > begin) words.push_back(text.substr(begin, end - begin));
    begin = end + 1;
  }
  return words;
}

}  // namespace cornerd::tool
