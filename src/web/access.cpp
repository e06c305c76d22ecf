// SPDX-License-Identifier: MIT
#include "web/access.hpp"

#include <arpa/inet.h>

#include <algorithm>
#include <cctype>

namespace cornerd::web {

namespace {

std::string lower_case(std::string_view text) {
  std::string lower(text);
  std::transform(lower.begin(), lower.end(), lower.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return lower;
}

bool is_port(std::string_view text) {
  return !text.empty() && text.size() <= 5 &&
         std::all_of(text.begin(), text.end(), [](char c) { return c >= '0' && c <= '9'; });
}

bool is_address(int family, const std::string& text) {
  unsigned char address[sizeof(in6_addr)];
  return ::inet_pton(family, text.c_str(), address) == 1;
}

bool is_label_text(std::string_view name) {
  return std::all_of(name.begin(), name.end(), [](unsigned char c) {
    return std::isalnum(c) != 0 || c == '-' || c == '.' || c == '_';
  });
}

/// The name in "NAME", "NAME:PORT", "[IPV6]" or "[IPV6]:PORT", with its brackets; empty for any
/// other text.
std::string_view without_port(std::string_view host) {
  const std::size_t end = host.starts_with('[') ? host.find(']') + 1 : host.find(':');
  if (end == 0) return {};
  const std::string_view rest = end < host.size() ? host.substr(end) : std::string_view();
  if (!rest.empty() && (rest[0] != ':' || !is_port(rest.substr(1)))) return {};
  return host.substr(0, end);
}

}  // namespace

bool is_allowed_host(std::string_view host, std::string_view own_name) {
  std::string name = lower_case(without_port(host));
  if (name.starts_with('[')) return is_address(AF_INET6, name.substr(1, name.size() - 2));
  if (name.ends_with('.')) name.pop_back();
  if (name.empty() || !is_label_text(name)) return false;
  return name == "localhost" || name.ends_with(".local") || name == lower_case(own_name) ||
         is_address(AF_INET, name);
}

bool is_origin(std::string_view text) {
  const std::size_t colon = text.find("://");
  if (colon == std::string_view::npos || colon == 0) return false;
  const auto is_scheme = [](unsigned char c) {
    return std::isalnum(c) != 0 || c == '+' || c == '-' || c == '.';
  };
  const std::string_view name = without_port(text.substr(colon + 3));
  return std::all_of(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(colon), is_scheme) &&
         !name.empty() && std::none_of(name.begin(), name.end(), [](unsigned char c) {
           return c <= ' ' || c == '/' || c == '?' || c == '#' || c == '@' || c == '*';
         });
}

bool is_allowed_origin(std::string_view origin, std::string_view host,
                       const std::vector<std::string>& allowed) {
  if (origin.empty()) return true;
  const std::string lower = lower_case(origin);
  const std::string own = lower_case(host);
  // A proxy may add TLS.
  if (lower == "http://" + own || lower == "https://" + own) return true;
  return std::any_of(allowed.begin(), allowed.end(),
                     [&](const std::string& one) { return lower_case(one) == lower; });
}

bool has_token(const Request& request, std::string_view token) {
  if (token.empty()) return false;
  constexpr std::string_view kScheme = "bearer ";
  std::string given;
  if (lower_case(std::string_view(request.authorization).substr(0, kScheme.size())) == kScheme) {
    given = request.authorization.substr(kScheme.size());
  } else {
    given = query_value(request.query, "token");
  }
  if (given.size() != token.size()) return false;
  unsigned difference = 0;
  for (std::size_t i = 0; i < token.size(); ++i) {
    difference |= static_cast<unsigned char>(given[i]) ^ static_cast<unsigned char>(token[i]);
  }
  return difference == 0;
}

bool may_change(const Request& request, const AccessRules& rules) {
  return rules.token.empty() ? request.from_loopback : has_token(request, rules.token);
}

bool may_read(const Request& request, const AccessRules& rules) {
  return !rules.is_private || has_token(request, rules.token);
}

}  // namespace cornerd::web
