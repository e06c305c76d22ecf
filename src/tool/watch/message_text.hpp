// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "message/parsed_line.hpp"

namespace cornerd::tool {

/// A message of the daemon for a person, with a newline at the end; empty for those that are only
/// numbers (SCAN, BREAKPOINTS, MAP).
std::string message_text(const message::ParsedLine& line);

}  // namespace cornerd::tool
