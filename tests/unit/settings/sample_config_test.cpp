// SPDX-License-Identifier: MIT
// config/cornerd.full.json and config/keys.md are made from the table of keys. To write them
// anew: CORNERD_UPDATE_GOLDEN=1 unit_settings
#include <gtest/gtest.h>

#include <array>
#include <charconv>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

#include "settings/config_table.hpp"

namespace cornerd::settings {
namespace {

const std::filesystem::path kFolder = std::filesystem::path(CORNERD_SOURCE_DIR) / "config";
constexpr std::size_t kColumns = 80;
constexpr int kDigits = 7;

/// A default, rounded for the reader.
std::string default_text(const Key& key) {
  const nlohmann::ordered_json value = key.value.write();
  if (value.is_number_float()) {
    std::array<char, 32> digits;
    return {digits.data(), std::to_chars(digits.begin(), digits.end(), value.get<double>(),
                                         std::chars_format::general, kDigits)
                               .ptr};
  }
  return value.dump();
}

bool has_default(const Key& key) { return key.value.write() != ""; }

/// The pages show the map of the package.
Config shown_config() {
  Config config;
  config.map = "/usr/share/cornerd/maps/krpai-2019-a.json";
  return config;
}

/// Lines of a comment, none longer than kColumns.
std::string comment(const std::string& text, const std::string& indent) {
  std::string lines;
  std::string line;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find(' ', begin), text.size());
    const std::string word = text.substr(begin, end - begin);
    if (!line.empty() && line.size() + 1 + word.size() > kColumns) {
      lines += line + "\n";
      line.clear();
    }
    line += (line.empty() ? indent + "// " : " ") + word;
    begin = end + 1;
  }
  return line.empty() ? lines : lines + line + "\n";
}

/// The object of the keys below `section`.
std::string object_text(const std::vector<Key>& table, const std::string& section,
                        const std::string& indent) {
  std::vector<std::string> members;
  std::string comments;
  std::string last_section;
  for (const Key& key : table) {
    if (!key.pointer.starts_with(section + "/")) continue;
    const std::string rest = key.pointer.substr(section.size() + 1);
    const std::string name = rest.substr(0, rest.find('/'));
    const bool is_leaf = rest == name && !key.is_section();
    if (!is_leaf && name == last_section) continue;
    if (rest == name) comments += comment(key.text, indent);
    if (is_leaf && !has_default(key)) {
      comments += indent + "// \"" + name + "\": \"...\",\n";
      continue;
    }
    std::string value =
        is_leaf ? default_text(key) : object_text(table, section + "/" + name, indent + "  ");
    if (is_leaf && indent.size() + name.size() + value.size() > kColumns - 10) {
      value = key.value.write().dump(2);
      for (std::size_t i = 0; (i = value.find('\n', i)) != std::string::npos; i += indent.size()) {
        value.insert(++i, indent);
      }
    }
    members.push_back(comments + indent + '"' + name + "\": " + value);
    comments.clear();
    if (!is_leaf) last_section = name;
  }
  std::string text = "{\n";
  for (const std::string& member : members) {
    text += member + (&member == &members.back() ? "\n" : ",\n");
  }
  return text + comments + indent.substr(2) + "}";
}

std::string full_sample() {
  Config config = shown_config();
  return comment(
             "Every key of cornerd's settings with its default. A file needs no more than \"map\"; "
             "an unknown key is an error. Metres, radians, seconds; x forward, y left, theta "
             "counter-clockwise. A relative path is relative to the file that holds it. `cornerd "
             "--config FILE --check` reads a file like this one and reports what is wrong with it. "
             "keys.md has the limits.",
             "") +
         object_text(config_table(config), "", "  ") + "\n";
}

std::string page() {
  std::string text =
      "# Configuration\n\n"
      "`/etc/cornerd/cornerd.json` is JSON with `//` comments. [cornerd.json](cornerd.json) has "
      "the keys that most robots need,\n"
      "[cornerd.full.json](cornerd.full.json) has every key with its default. Only `map` has none. "
      "An unknown key,\n"
      "a wrong type or a value out of range is an error that names its JSON pointer (exit code "
      "78);\n"
      "`cornerd --config FILE --check` looks for them. `--set /json/pointer=value` replaces a "
      "value "
      "for one run.\n"
      "SIGHUP reads the file again; a key with \"yes\" under \"restart\" needs a restart. This "
      "page "
      "is made from the\n"
      "table of keys (src/settings/config_table.cpp).\n\n"
      "| key | default | values | restart | meaning |\n|---|---|---|---|---|\n";
  Config config = shown_config();
  for (const Key& key : config_table(config)) {
    text += "| `" + key.pointer + "` | ";
    if (key.is_section()) {
      text += "| | | " + key.text + " |\n";
      continue;
    }
    text += has_default(key) ? "`" + default_text(key) + "`" : "";
    text += " | " + key.value.limits;
    text += key.applies == Applies::kOnRestart ? " | yes | " : " | | ";
    text += key.text + " |\n";
  }
  return text;
}

struct Page {
  const char* file;
  std::string (*text)();
};
void PrintTo(const Page& page, std::ostream* out) { *out << page.file; }

class GeneratedPage : public testing::TestWithParam<Page> {};

TEST_P(GeneratedPage, File_MatchesTheTable) {
  const std::filesystem::path file = kFolder / GetParam().file;
  const std::string text = GetParam().text();
  if (std::getenv("CORNERD_UPDATE_GOLDEN") != nullptr) {
    std::ofstream(file) << text;
    return;
  }
  EXPECT_EQ(read_file(file, 1 << 20), text) << "to write it: CORNERD_UPDATE_GOLDEN=1 unit_settings";
}

INSTANTIATE_TEST_SUITE_P(Pages, GeneratedPage,
                         testing::Values(Page{"cornerd.full.json", full_sample},
                                         Page{"keys.md", page}));

class Sample : public testing::TestWithParam<const char*> {};

TEST_P(Sample, File_IsRead) {
  const std::filesystem::path file = kFolder / GetParam();
  EXPECT_NO_THROW(parse_config(read_file(file, 1 << 20), file, {}, /*require_map=*/false));
}

INSTANTIATE_TEST_SUITE_P(Config, Sample,
                         testing::Values("cornerd.json", "cornerd.full.json",
                                         "robots/contest-16cm.json", "robots/pioneer-p3dx.json"));

TEST(FullSample, EveryValue_IsTheDefault) {
  Config sample = load_config(kFolder / "cornerd.full.json");
  Config defaults = shown_config();
  const std::vector<Key> read = config_table(sample);
  const std::vector<Key> expected = config_table(defaults);
  for (std::size_t i = 0; i < read.size(); ++i) {
    if (!read[i].is_section()) {
      EXPECT_EQ(default_text(read[i]), default_text(expected[i])) << read[i].pointer;
    }
  }
}

}  // namespace
}  // namespace cornerd::settings
