// SPDX-License-Identifier: MIT
#include "settings/document.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cctype>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>
#include <set>
#include <vector>

#include "drivers/config/open_files.hpp"
#include "settings/config.hpp"

namespace cornerd::settings {
namespace {

constexpr std::size_t kMaxDepth = 16;
constexpr std::size_t kReadBytes = 64 * 1024;

/// "line 1, column 2: ..." of "[json.exception.parse_error.101] parse error at line 1, column 2:
/// ..."
std::string strip_library_prefix(std::string_view what) {
  constexpr std::string_view kPrefix = "parse error at ";
  const std::size_t prefix = what.find(kPrefix);
  if (prefix != std::string_view::npos) return std::string(what.substr(prefix + kPrefix.size()));
  const std::size_t bracket = what.find("] ");
  return std::string(bracket == std::string_view::npos ? what : what.substr(bracket + 2));
}

/// Where people write what YAML, Python or JavaScript takes; empty for anything else. `text`: up to
/// the character that is wrong.
std::string way_out(std::string_view what, std::string_view text) {
  if (text.empty()) return {};
  const char wrong = text.back();
  text.remove_suffix(1);
  const std::size_t before = text.find_last_not_of(" \t\r\n");
  const char last = before == std::string_view::npos ? '\0' : text[before];
  if ((wrong == '}' || wrong == ']') && last == ',')
    return "; JSON has no comma after the last one";
  // Of the library's words alone, not of the text that it quotes.
  if (what.substr(0, what.find("last read")).find("invalid literal") == std::string_view::npos)
    return {};
  if (wrong == '#') return "; a comment begins with //";
  if (wrong == '\'') return "; a string is in double quotes";
  if (std::isalpha(static_cast<unsigned char>(wrong)) == 0) return {};
  return "; JSON has the words true, false and null alone: others are strings in double quotes, "
         "and numbers have no unit";
}

/// Checks what the parsed document no longer shows: repeated keys and depth. A pass of its own: the
/// library's parser with a callback is quadratic in the elements of an array.
class StructureCheck : public Json::json_sax_t {
 public:
  StructureCheck(const std::filesystem::path& file, std::string_view text)
      : file_(file), text_(text) {}

  bool null() override { return begin_element(); }
  bool boolean(bool /*value*/) override { return begin_element(); }
  bool number_integer(number_integer_t /*value*/) override { return begin_element(); }
  bool number_unsigned(number_unsigned_t /*value*/) override { return begin_element(); }
  bool number_float(number_float_t /*value*/, const string_t& /*text*/) override {
    return begin_element();
  }
  bool string(string_t& /*value*/) override { return begin_element(); }
  bool binary(binary_t& /*value*/) override { return begin_element(); }
  bool start_object(std::size_t /*size*/) override { return open(/*is_array=*/false); }
  bool start_array(std::size_t /*size*/) override { return open(/*is_array=*/true); }
  bool end_object() override { return close(); }
  bool end_array() override { return close(); }

  bool key(string_t& name) override {
    Level& level = levels_.back();
    level.key = name;
    if (!level.seen.insert(name).second) {
      throw SettingsError(file_.string(), pointer(), "this key is there twice");
    }
    return true;
  }

  bool parse_error(std::size_t position, const std::string& /*token*/,
                   const Json::exception& error) override {
    std::string where;
    if (dynamic_cast<const Json::out_of_range*>(&error) != nullptr) {
      begin_element();
      where = pointer();
    }
    throw SettingsError(file_.string(), where,
                        one_line(strip_library_prefix(error.what())) +
                            way_out(error.what(), text_.substr(0, position)));
  }

 private:
  struct Level {
    bool is_array = false;
    std::size_t count = 0;  ///< elements of an array, the current one included
    std::string key{};
    std::set<std::string> seen{};
  };

  bool begin_element() {
    if (!levels_.empty()) ++levels_.back().count;
    return true;
  }

  bool open(bool is_array) {
    begin_element();
    if (levels_.size() == kMaxDepth) {
      throw SettingsError(file_.string(), pointer(), "nested too deep");
    }
    levels_.push_back({.is_array = is_array});
    return true;
  }

  bool close() {
    levels_.pop_back();
    return true;
  }

  std::string pointer() const {
    std::string text;
    for (const Level& level : levels_) {
      text = child_pointer(text, level.is_array ? std::to_string(level.count - 1) : level.key);
    }
    return text;
  }

  const std::filesystem::path& file_;
  std::string_view text_;
  std::vector<Level> levels_;
};

struct FileCloser {
  void operator()(std::FILE* stream) const { std::fclose(stream); }
};
using FileStream = std::unique_ptr<std::FILE, FileCloser>;

/// Null, with errno set, where it cannot be opened.
FileStream open_to_read(const std::filesystem::path& file, FileKind kind) {
  const int non_blocking = kind == FileKind::kOrdinary ? O_NONBLOCK : 0;
  const int fd = ::open(file.c_str(), O_RDONLY | O_CLOEXEC | O_NOCTTY | non_blocking);
  if (fd < 0) return nullptr;
  FileStream stream(::fdopen(fd, "rb"));
  if (!stream) ::close(fd);
  return stream;
}

/// RFC 6901, section 4.
std::string unescape(std::string_view token) {
  std::string key;
  for (std::size_t i = 0; i < token.size(); ++i) {
    if (token[i] == '~' && i + 1 < token.size()) {
      key += token[++i] == '1' ? '/' : '~';
    } else {
      key += token[i];
    }
  }
  return key;
}

}  // namespace

std::string read_file(const std::filesystem::path& file, std::size_t max_bytes, FileKind kind) {
  const auto fail = [&file](const std::string& reason) {
    throw SettingsError(file.string(), "", reason);
  };
  const FileStream stream = open_to_read(file, kind);
  if (!stream) {
    const int error = errno;
    fail(std::string("cannot be opened: ") + std::strerror(error) +
         drivers::open_files_hint(error));
  }
  struct stat found {};
  if (::fstat(::fileno(stream.get()), &found) != 0) fail(std::strerror(errno));
  if (S_ISDIR(found.st_mode)) fail("is a folder");
  if (kind == FileKind::kOrdinary && !S_ISREG(found.st_mode)) fail("is no ordinary file");
  std::string text;
  std::vector<char> block(kReadBytes);
  while (const std::size_t size = std::fread(block.data(), 1, block.size(), stream.get())) {
    text.append(block.data(), size);
    if (text.size() > max_bytes) fail("longer than " + std::to_string(max_bytes) + " bytes");
  }
  if (std::ferror(stream.get()) != 0) fail(std::string("cannot be read: ") + std::strerror(errno));
  return text;
}

Json parse_document(std::string_view text, const std::filesystem::path& file) {
  StructureCheck check(file, text);
  Json::sax_parse(text, &check, Json::input_format_t::json, /*strict=*/true,
                  /*ignore_comments=*/true);
  return Json::parse(text, nullptr, /*allow_exceptions=*/true, /*ignore_comments=*/true);
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

bool is_override(std::string_view text) {
  const std::size_t equals = text.find('=');
  return equals != std::string_view::npos && equals >= 2 && text.front() == '/';
}

std::string apply_override(Json& document, std::string_view text) {
  const std::size_t equals = text.find('=');
  const std::string pointer(text.substr(0, equals));
  if (!is_override(text)) {
    throw SettingsError("override \"" + std::string(text) + "\"", "",
                        "must be /json/pointer=value");
  }
  Json* target = &document;
  std::string_view rest = std::string_view(pointer).substr(1);
  for (bool is_last = false; !is_last;) {
    const std::size_t slash = rest.find('/');
    is_last = slash == std::string_view::npos;
    const std::string key = unescape(rest.substr(0, slash));
    if (!is_last) rest.remove_prefix(slash + 1);
    if (target->is_null()) *target = Json::object();
    if (!target->is_object()) {
      throw SettingsError("override", pointer, "\"" + key + "\" would be inside what is no object");
    }
    target = &(*target)[key];
  }
  const std::string_view value = text.substr(equals + 1);
  *target = Json::parse(value, nullptr, /*allow_exceptions=*/false);
  if (target->is_discarded()) *target = std::string(value);
  return pointer;
}

}  // namespace cornerd::settings
