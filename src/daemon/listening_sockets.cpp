// SPDX-License-Identifier: MIT
#include "daemon/listening_sockets.hpp"

#include <sys/stat.h>

#include <fstream>
#include <sstream>
#include <string>

namespace cornerd::daemon {
namespace {

/// __SO_ACCEPTCON of linux/net.h, in the column of flags.
constexpr unsigned long kListens = 0x10000;

bool is_same(const std::filesystem::path& file, const std::filesystem::path& listed) {
  if (listed.is_relative()) return listed.filename() == file.filename();
  if (listed == file) return true;
  struct stat one {};
  struct stat other {};
  return ::stat(listed.c_str(), &one) == 0 && ::stat(file.c_str(), &other) == 0 &&
         one.st_dev == other.st_dev && one.st_ino == other.st_ino;
}

}  // namespace

std::optional<bool> somebody_listens(const std::filesystem::path& file) {
  std::ifstream list("/proc/self/net/unix");
  std::string heading;
  if (!std::getline(list, heading)) return std::nullopt;
  return somebody_listens(file, list);
}

bool somebody_listens(const std::filesystem::path& file, std::istream& list) {
  for (std::string line; std::getline(list, line);) {
    // Num RefCount Protocol Flags Type St Inode Path
    std::istringstream words(line);
    std::string word;
    unsigned long flags = 0;
    words >> word >> word >> word >> std::hex >> flags >> word >> word >> word >> std::ws;
    std::string path;
    if (std::getline(words, path) && (flags & kListens) != 0 && is_same(file, path)) return true;
  }
  return false;
}

}  // namespace cornerd::daemon
