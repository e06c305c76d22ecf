// SPDX-License-Identifier: MIT
#include "web/map_store.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <vector>

#include <nlohmann/json.hpp>

#include "settings/map_file.hpp"

namespace cornerd::web {

namespace {

using nlohmann::json;

/// Writes all bytes and syncs; errno tells what failed.
bool write_file(int fd, std::string_view text) {
  while (!text.empty()) {
    const ssize_t written = ::write(fd, text.data(), text.size());
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) return false;
    text.remove_prefix(static_cast<std::size_t>(written));
  }
  return ::fsync(fd) == 0;
}

/// Comments and names may come before the format; what is no map is not offered.
bool looks_like_a_map(const std::filesystem::path& file) {
  if (std::error_code ignored; !std::filesystem::is_regular_file(file, ignored)) return false;
  std::array<char, 4096> head{};
  std::ifstream stream(file, std::ios::binary);
  stream.read(head.data(), head.size());
  const std::string_view text(head.data(), static_cast<std::size_t>(stream.gcount()));
  return text.find("\"cornerd-map\"") != text.npos;
}

}  // namespace

bool is_map_name(std::string_view name) {
  return !name.empty() && name.size() <= 64 && name[0] != '.' &&
         std::all_of(name.begin(), name.end(), [](unsigned char c) {
           return std::isalnum(c) != 0 || c == '-' || c == '_' || c == '.';
         });
}

Response MapStore::list() const {
  std::vector<std::filesystem::path> files;
  std::error_code error;
  if (!folder_.empty()) {
    for (std::filesystem::directory_iterator entry(folder_, error), end; !error && entry != end;
         entry.increment(error)) {
      const std::filesystem::path& file = entry->path();
      if (file.extension() == ".json" && is_map_name(file.stem().native()) &&
          looks_like_a_map(file)) {
        files.push_back(file);
      }
    }
  }
  if (error) {
    return error_response(500, "maps", folder_.string() + ": " + error.message());
  }
  std::sort(files.begin(), files.end());
  json maps = json::array();
  for (const auto& file : files) {
    maps.push_back({{"name", file.stem().native()}, {"file", file.native()}});
  }
  return {.body = maps.dump() + "\n"};
}

Response MapStore::check(const std::string& map) {
  try {
    const auto parsed = settings::parse_map(map, "map");
    const core::Vec2 size = parsed->upper_right() - parsed->lower_left();
    const json answer = {{"class", "OK"},
                         {"name", parsed->plan().name},
                         {"width", size.x()},
                         {"height", size.y()},
                         {"walls", parsed->plan().walls.size()},
                         {"corners", parsed->corners().size()},
                         {"rooms", parsed->plan().rooms.size()}};
    return {.body = answer.dump() + "\n"};
  } catch (const settings::SettingsError& error) {
    return error_response(422, "map", error.what());
  }
}

Response MapStore::put(std::string_view name, const std::string& map) const {
  if (folder_.empty()) {
    return error_response(404, "maps", "no folder of maps: start cornerd-web with --maps DIR");
  }
  if (!is_map_name(name)) {
    return error_response(400, "name",
                          "a map's name has at most 64 letters, digits, '-', '_' and '.'");
  }
  if (Response checked = check(map); checked.status != 200) return checked;
  const std::string file = (folder_ / (std::string(name) + ".json")).native();
  // Complete before it has its name; link() refuses a name that is taken.
  std::string temporary = (folder_ / ".new-XXXXXX").native();
  const int fd = ::mkostemp(temporary.data(), O_CLOEXEC);
  if (fd < 0) return error_response(500, "maps", folder_.string() + ": " + std::strerror(errno));
  int failure = 0;
  if (!write_file(fd, map) || ::fchmod(fd, 0644) != 0) failure = errno;
  ::close(fd);
  if (failure == 0 && ::link(temporary.c_str(), file.c_str()) != 0) failure = errno;
  ::unlink(temporary.c_str());
  if (failure == EEXIST) {
    return error_response(409, "exists", file + " exists; choose another name");
  }
  if (failure != 0) return error_response(500, "maps", file + ": " + std::strerror(failure));
  const json answer = {{"class", "OK"}, {"name", name}, {"file", file}};
  return {.status = 201, .body = answer.dump() + "\n"};
}

}  // namespace cornerd::web
