// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>

#include "web/http.hpp"

namespace cornerd::web {

/// Sends one request line to the control socket and waits for its answer: 200 with OK, 409 with
/// ERROR, 503 if nobody answers. `body`: one JSON object. Blocks for seconds at most.
Response ask_daemon(const std::filesystem::path& control_socket, const std::string& body);

}  // namespace cornerd::web
