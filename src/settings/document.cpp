// SPDX-License-Identifier: MIT
#include "settings/document.hpp"

#include <cerrno>
#include <cstring>
#include <fstream>
#include <set>
#include <vector>

#include "settings/config.hpp"

namespace cornerd::settings {
namespace {

constexpr std::size_t kMaxDepth = 16;

/// Watches the parser build the document, for what the document itself no longer shows.
class StructureCheck {
 public:
  explicit StructureCheck(const std::filesystem::path& file) : file_(file) {}

  /// Of a value that the parser could not make.
  std::string pointer_of_next() {
    begin_element();
    return pointer();
  }

  bool operator()(Json::parse_event_t event, const Json& parsed) {
    switch (event) {
      case Json::parse_event_t::key:
        levels_.back().key = parsed.get<std::string>();
        if (!levels_.back().seen.insert(levels_.back().key).second) {
          throw SettingsError(file_.string(), pointer(), "this key is there twice");
        }
        break;
      case Json::parse_event_t::object_start:
      case Json::parse_event_t::array_start:
        if (levels_.size() == kMaxDepth) {
          throw SettingsError(file_.string(), pointer(), "nested too deep");
        }
        begin_element();
        levels_.push_back({.is_array = event == Json::parse_event_t::array_start});
        break;
      case Json::parse_event_t::object_end:
      case Json::parse_event_t::array_end:
        levels_.pop_back();
        break;
      case Json::parse_event_t::value:
        begin_element();
        break;
    }
    return true;
  }

 private:
  struct Level {
    bool is_array = false;
    std::size_t count = 0;  ///< elements of an array, the current one included
    std::string key{};
    std::set<std::string> seen{};
  };

  void begin_element() {
    if (!levels_.empty()) ++levels_.back().count;
  }

  std::string pointer() const {
    std::string text;
    for (const Level& level : levels_) {
      text = child_pointer(text, level.is_array ? std::to_string(level.count - 1) : level.key);
    }
    return text;
  }

  const std::filesystem::path& file_;
  std::vector<Level> levels_;
};

/// The library's "[json.exception.parse_error.101] parse error at line 1, column 2: ..." without
/// its own name for it.
std::string strip_library_prefix(std::string_view what) {
  constexpr std::string_view kLead = "parse error at ";
  const std::size_t lead = what.find(kLead);
  if (lead != std::string_view::npos) return std::string(what.substr(lead + kLead.size()));
  const std::size_t bracket = what.find("] ");
  return std::string(bracket == std::string_view::npos ? what : what.substr(bracket + 2));
}

}  // namespace

std::string read_file(const std::filesystem::path& file, std::size_t max_bytes) {
  const auto fail = [&file](const std::string& reason) {
    throw SettingsError(file.string(), "", reason);
  };
  std::error_code ignored;
  if (std::filesystem::is_directory(file, ignored)) fail("is a folder");
  std::ifstream stream(file, std::ios::binary);
  if (!stream) fail(std::string("cannot be opened: ") + std::strerror(errno));
  std::string text;
  std::array<char, 64 * 1024> block;
  while (stream.read(block.data(), block.size()) || stream.gcount() > 0) {
    text.append(block.data(), static_cast<std::size_t>(stream.gcount()));
    if (text.size() > max_bytes) fail("longer than " + std::to_string(max_bytes) + " bytes");
  }
  if (stream.bad()) fail(std::string("cannot be read: ") + std::strerror(errno));
  return text;
}

Json parse_document(std::string_view text, const std::filesystem::path& file) {
  StructureCheck check(file);
  try {
    return Json::parse(
        text,
        [&check](int /*depth*/, Json::parse_event_t event, const Json& parsed) {
          return check(event, parsed);
        },
        /*allow_exceptions=*/true, /*ignore_comments=*/true);
  } catch (const Json::out_of_range& error) {
    throw SettingsError(file.string(), check.pointer_of_next(), strip_library_prefix(error.what()));
  } catch (const Json::exception& error) {
    throw SettingsError(file.string(), "", strip_library_prefix(error.what()));
  }
}

std::string child_pointer(const std::string& parent, std::string_view key) {
  std::string pointer = parent + "/";
  for (const char c : key) {
    if (c == '~') {
      pointer += "~0";
    } else if (c == '/') {
      pointer += "~1";
    } else {
      pointer += c;
    }
  }
  return pointer;
}

}  // namespace cornerd::settings
