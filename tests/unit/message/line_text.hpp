// SPDX-License-Identifier: MIT
#pragma once

#include <gtest/gtest.h>

#include <string_view>

#include <nlohmann/json.hpp>

namespace cornerd::message {

/// Parses a line as a client does and checks that it is one line.
inline nlohmann::json read(std::string_view line) {
  EXPECT_EQ(line.find('\n'), line.size() - 1) << line;
  return nlohmann::json::parse(line);
}

}  // namespace cornerd::message
