// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

namespace cornerd::client {

/// What one request of the control socket got.
struct Answer {
  enum class Kind : std::uint8_t {
    kOk,
    kError,  ///< the daemon refused it
    kNone,   ///< nobody answered
  };
  Kind kind = Kind::kNone;
  std::string text;  ///< the line of OK or ERROR; else why there is none
};

/// Connects, sends `line`, with its newline, and waits for OK or ERROR. Blocks up to `timeout`.
Answer ask(const std::filesystem::path& socket, std::string_view line,
           std::chrono::milliseconds timeout);

}  // namespace cornerd::client
