// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include "mqtt/broker.hpp"
#include "web/access.hpp"

namespace cornerd::web {

struct ServerConfig {
  std::string address = "127.0.0.1";
  std::uint16_t port = 8088;  ///< 0: any free one, printed at the start
  std::filesystem::path pose_socket;
  std::filesystem::path control_socket;
  std::filesystem::path maps;  ///< empty: none
  AccessRules access;
  std::optional<mqtt::BrokerConfig> broker;  ///< of a fleet
  std::string site;
};

/// Serves until SIGTERM or SIGINT. Throws std::runtime_error if it cannot listen.
void serve(const ServerConfig& config);

}  // namespace cornerd::web
