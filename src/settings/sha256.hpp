// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>

namespace cornerd::settings {

/// SHA-256 of the bytes (FIPS 180-4, section 6.2): 64 hexadecimal digits, lower case.
std::string sha256(std::string_view bytes);

}  // namespace cornerd::settings
