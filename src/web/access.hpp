// SPDX-License-Identifier: MIT
// Who may do what: a page of another site must neither read nor change anything here.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "web/http.hpp"

namespace cornerd::web {

struct AccessRules {
  std::string own_name;                      ///< of this machine, without a domain
  std::string token;                         ///< empty: none is set
  std::vector<std::string> allowed_origins;  ///< "https://app.example.org"
  bool is_private = false;                   ///< reading needs the token too
};

/// True for an IP literal, localhost, a name below .local and the own name, with or without a port.
/// Any other name may be one that an attacker points at this machine (DNS rebinding).
bool is_allowed_host(std::string_view host, std::string_view own_name);

/// True for what a browser may send as Origin of a page: scheme, host and no more than a port.
bool is_origin(std::string_view text);

/// True for no origin, that of the page itself, and the allowed ones.
bool is_allowed_origin(std::string_view origin, std::string_view host,
                       const std::vector<std::string>& allowed);

/// True if `Authorization: Bearer T` or `?token=T` has the token. Takes the same time for any wrong
/// one of its length. False if no token is set.
bool has_token(const Request& request, std::string_view token);

/// With a token set, its bearers; without one, clients on this machine.
bool may_change(const Request& request, const AccessRules& rules);
bool may_read(const Request& request, const AccessRules& rules);

}  // namespace cornerd::web
