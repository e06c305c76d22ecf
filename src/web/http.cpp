// SPDX-License-Identifier: MIT
#include "web/http.hpp"

#include <optional>

#include "message/json_text.hpp"

namespace cornerd::web {

namespace {

int hex_digit(char c) {
  if (c >= '0' && c <= '9') return c - '0';
  if (c >= 'a' && c <= 'f') return c - 'a' + 10;
  if (c >= 'A' && c <= 'F') return c - 'A' + 10;
  return -1;
}

std::optional<std::string> decode(std::string_view text) {
  std::string decoded;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] != '%') {
      decoded += text[i];
      continue;
    }
    if (i + 2 >= text.size()) return std::nullopt;
    const int high = hex_digit(text[i + 1]);
    const int low = hex_digit(text[i + 2]);
    if (high < 0 || low < 0) return std::nullopt;
    decoded += static_cast<char>(high * 16 + low);
    i += 2;
  }
  return decoded;
}

}  // namespace

Response error_response(unsigned status, std::string_view code, std::string_view message) {
  message::JsonText json(64 + message.size());
  json.open_object();
  json.string("class", "ERROR");
  json.string("code", code);
  json.string("message", message);
  json.close_object();
  json.end_line();
  Response response;
  response.status = status;
  response.body = json.view();
  return response;
}

bool set_target(std::string_view target, Request& request) {
  if (!target.starts_with('/')) return false;
  const std::size_t mark = target.find('?');
  const auto path = decode(target.substr(0, mark));
  if (!path || path->find('\0') != std::string::npos) return false;
  request.path = *path;
  request.query = mark == std::string_view::npos ? "" : target.substr(mark + 1);
  return true;
}

std::string query_value(std::string_view query, std::string_view name) {
  while (!query.empty()) {
    const std::size_t end = query.find('&');
    const std::string_view pair = query.substr(0, end);
    query = end == std::string_view::npos ? std::string_view{} : query.substr(end + 1);
    if (pair.size() > name.size() && pair.starts_with(name) && pair[name.size()] == '=') {
      return decode(pair.substr(name.size() + 1)).value_or("");
    }
  }
  return {};
}

}  // namespace cornerd::web
