// SPDX-License-Identifier: MIT
#include "xml_check.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <regex>
#include <vector>

namespace cornerd::tool {

namespace {

/// No bare ampersand, no angle bracket, no control character.
bool is_text(std::string_view text) {
  static constexpr std::array<std::string_view, 5> kEntities = {"&amp;", "&lt;", "&gt;", "&quot;",
                                                                "&#39;"};
  for (std::size_t at = 0; at < text.size(); ++at) {
    const auto c = static_cast<unsigned char>(text[at]);
    if (c == '<' || (c < 0x20 && c != '\n' && c != '\t')) return false;
    if (c == '&' && std::none_of(kEntities.begin(), kEntities.end(), [&](std::string_view entity) {
          return text.substr(at).starts_with(entity);
        })) {
      return false;
    }
  }
  return true;
}

/// An opening tag without its angle brackets: name, and attributes in quotes.
bool is_opening(const std::string& inside, std::string& name) {
  static const std::regex kHead("^[a-z]+");
  static const std::regex kAttribute("^\\s+[A-Za-z:-]+=\"");
  std::smatch match;
  if (!std::regex_search(inside, match, kHead)) return false;
  name = match.str();
  std::string rest = match.suffix();
  while (std::regex_search(rest, match, kAttribute)) {
    const std::string value = match.suffix();
    const std::size_t quote = value.find('"');
    if (quote == std::string::npos || !is_text(value.substr(0, quote))) return false;
    rest = value.substr(quote + 1);
  }
  return rest.empty() || rest == "/";
}

}  // namespace

std::string find_xml_error(std::string_view document) {
  std::vector<std::string> open;
  std::size_t roots = 0;
  for (std::size_t at = 0; at < document.size();) {
    const std::size_t tag = document.find('<', at);
    const std::string_view text = document.substr(at, tag - at);
    if (!is_text(text)) return "bad text: " + std::string(text);
    if (tag == std::string_view::npos) break;
    const std::size_t end = document.find('>', tag);
    if (end == std::string_view::npos) return "a tag without an end";
    const std::string inside(document.substr(tag + 1, end - tag - 1));
    at = end + 1;

    std::string name;
    if (inside.starts_with('/')) {
      if (open.empty() || open.back() != inside.substr(1)) return "does not match: " + inside;
      open.pop_back();
    } else if (is_opening(inside, name)) {
      if (open.empty()) ++roots;
      if (!inside.ends_with('/')) open.push_back(name);
    } else {
      return "no tag: " + inside;
    }
  }
  if (!open.empty()) return "never closed: " + open.back();
  return roots == 1 ? "" : std::to_string(roots) + " roots";
}

std::size_t count_elements(std::string_view document, std::string_view element) {
  std::size_t count = 0;
  const std::string tag = "<" + std::string(element);
  for (std::size_t at = document.find(tag); at != std::string_view::npos;
       at = document.find(tag, at + 1)) {
    if (std::isalnum(static_cast<unsigned char>(document[at + tag.size()])) == 0) ++count;
  }
  return count;
}

}  // namespace cornerd::tool
