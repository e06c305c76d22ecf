// SPDX-License-Identifier: MIT
// What the kernel writes into an attribute of sysfs, as a number.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

namespace cornerd::drivers {

/// The text without the newline that ends it.
std::string_view without_newline(std::string_view text);

/// "1234\n", "-128\n": nothing else around the digits. Nullopt for any other bytes, and for what a
/// 64-bit signed integer does not hold.
std::optional<std::int64_t> parse_integer(std::string_view text);

/// "0.001064724\n", "-3\n": digits with or without a fraction, as IIO prints its scales. Nullopt
/// for any other bytes, exponents, infinities and NaN included.
std::optional<double> parse_decimal(std::string_view text);

}  // namespace cornerd::drivers
