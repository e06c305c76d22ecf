// SPDX-License-Identifier: MIT
#include "mqtt/map_folder.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <optional>
#include <system_error>
#include <utility>

#include "mqtt/map_announcement.hpp"
#include "settings/document.hpp"
#include "settings/map_file.hpp"
#include "settings/sha256.hpp"

namespace cornerd::mqtt {

namespace {

namespace fs = std::filesystem;

/// The map in use, and the one to go back to.
constexpr std::size_t kKept = 2;

/// nullopt if it is no file of the map.
std::optional<std::uint64_t> version_of(const std::string& name, const std::string& map) {
  constexpr std::string_view kSuffix = ".json";
  if (!name.starts_with(map + ".") || !name.ends_with(kSuffix)) return std::nullopt;
  const char* const begin = name.data() + map.size() + 1;
  const char* const end = name.data() + name.size() - kSuffix.size();
  std::uint64_t version = 0;
  const auto [parsed_to, error] = std::from_chars(begin, end, version);
  if (begin >= end || error != std::errc() || parsed_to != end) return std::nullopt;
  return version;
}

[[noreturn]] void fail(const fs::path& path) {
  throw std::system_error(errno, std::generic_category(), path.string());
}

/// Whole under its name, or not there, after a power cut too.
void write_whole(const fs::path& folder, const fs::path& path, std::string_view text) {
  std::string temporary = (folder / ".new-XXXXXX").native();
  const int fd = ::mkostemp(temporary.data(), O_CLOEXEC);
  if (fd < 0) fail(folder);
  bool is_written = true;
  while (is_written && !text.empty()) {
    const ssize_t written = ::write(fd, text.data(), text.size());
    is_written = written > 0;
    if (is_written) text.remove_prefix(static_cast<std::size_t>(written));
  }
  is_written = is_written && ::fchmod(fd, 0644) == 0 && ::fsync(fd) == 0;
  is_written = ::close(fd) == 0 && is_written;
  if (!is_written || ::rename(temporary.c_str(), path.c_str()) != 0) {
    const int error = errno;
    ::unlink(temporary.c_str());
    errno = error;
    fail(path);
  }
}

}  // namespace

MapFolder::MapFolder(fs::path folder, std::string map)
    : folder_(std::move(folder)), map_(std::move(map)) {
  std::error_code error;
  for (fs::directory_iterator entry(folder_, error), end; !error && entry != end;
       entry.increment(error)) {
    const auto version = version_of(entry->path().filename(), map_);
    if (!version) continue;
    try {
      const std::string text =
          settings::read_file(entry->path(), kMaxFleetMapBytes, settings::FileKind::kOrdinary);
      settings::parse_map(text, entry->path());
      files_.push_back({*version, settings::sha256(text), entry->path()});
    } catch (const settings::SettingsError&) {
      // Damaged: the broker has it.
    }
  }
  std::sort(files_.begin(), files_.end(),
            [](const File& a, const File& b) { return a.version > b.version; });
}

void MapFolder::add(std::uint64_t version, std::string_view text) {
  const fs::path path = folder_ / (map_ + "." + std::to_string(version) + ".json");
  write_whole(folder_, path, text);
  files_.insert(files_.begin(), {version, settings::sha256(text), path});
  for (; files_.size() > kKept; files_.pop_back()) {
    std::error_code ignored;
    fs::remove(files_.back().path, ignored);
  }
}

void MapFolder::drop_newest() {
  std::error_code ignored;
  fs::remove(files_.front().path, ignored);
  files_.erase(files_.begin());
}

}  // namespace cornerd::mqtt
