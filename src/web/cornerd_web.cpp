// SPDX-License-Identifier: MIT
#include "web/cornerd_web.hpp"

#include <unistd.h>

#include <array>
#include <charconv>
#include <filesystem>
#include <fstream>
#include <memory>
#include <string>
#include <vector>

#include "mqtt/config.hpp"
#include "settings/config.hpp"
#include "tool/command_line/command.hpp"
#include "tool/command_line/failure.hpp"
#include "web/server.hpp"

namespace cornerd::web {

namespace {

constexpr std::size_t kMinTokenBytes = 16;

struct ProgramOptions {
  std::string listen = "127.0.0.1:8088";
  std::filesystem::path pose = settings::SocketConfig{}.pose;
  std::filesystem::path control = settings::SocketConfig{}.control;
  std::filesystem::path token_file;
  std::filesystem::path maps;
  std::vector<std::string> allowed_origins;
  mqtt::FleetOptions fleet;
  bool is_private = false;
};

/// "127.0.0.1:8088" or "[::]:8088".
void set_endpoint(const std::string& listen, ServerConfig& config) {
  const std::size_t colon = listen.rfind(':');
  const std::string port = colon == std::string::npos ? "" : listen.substr(colon + 1);
  const auto [end, error] = std::from_chars(port.data(), port.data() + port.size(), config.port);
  if (port.empty() || error != std::errc() || end != port.data() + port.size()) {
    throw tool::UsageError("--listen takes ADDRESS:PORT, such as 127.0.0.1:8088, not \"" + listen +
                           "\"");
  }
  config.address = listen.substr(0, colon);
  if (config.address.starts_with('[') && config.address.ends_with(']')) {
    config.address = config.address.substr(1, config.address.size() - 2);
  }
}

/// The first line.
std::string read_token(const std::filesystem::path& file) {
  std::ifstream stream(file);
  std::string token;
  if (!std::getline(stream, token)) throw tool::Failure(file.string() + ": cannot be read");
  if (token.size() < kMinTokenBytes) {
    throw tool::Failure(file.string() +
                        ": a token has 16 characters or more: openssl rand -hex 16");
  }
  return token;
}

void set_fleet(const mqtt::FleetOptions& options, ServerConfig& config) try {
  config.site = options.site_name();
  if (options.is_given()) config.broker = options.broker_config();
} catch (const std::invalid_argument& error) {
  throw tool::UsageError(error.what());
}

void run(const ProgramOptions& options) {
  ServerConfig config;
  set_endpoint(options.listen, config);
  set_fleet(options.fleet, config);
  config.pose_socket = options.pose;
  config.control_socket = options.control;
  if (std::error_code error;
      !options.maps.empty() && !std::filesystem::is_directory(options.maps, error)) {
    throw tool::Failure("--maps " + options.maps.string() + ": " +
                        (error ? error.message() : "is no folder") + "; make it, or name another");
  }
  for (const std::string& origin : options.allowed_origins) {
    if (is_origin(origin)) continue;
    throw tool::UsageError(
        "--allow-origin takes what a browser sends as Origin, such as "
        "https://app.example.org, without a path, not \"" +
        origin + "\"");
  }
  if (!options.maps.empty()) config.maps = std::filesystem::absolute(options.maps);
  if (!options.token_file.empty()) config.access.token = read_token(options.token_file);
  config.access.allowed_origins = options.allowed_origins;
  config.access.is_private = options.is_private;
  if (options.is_private && config.access.token.empty()) {
    throw tool::UsageError("--private needs a token: --token-file FILE");
  }
  std::array<char, 256> name{};
  if (::gethostname(name.data(), name.size() - 1) == 0) config.access.own_name = name.data();
  config.access.own_name = config.access.own_name.substr(0, config.access.own_name.find('.'));
  serve(config);
}

}  // namespace

int run_cornerd_web(int argc, const char* const* argv) {
  const auto add = [](tool::Command& program) {
    const auto options = std::make_shared<ProgramOptions>();
    program
        .add_option("--listen", options->listen,
                    "another address than loopback is read-only "
                    "without a token")
        .type_name("ADDRESS:PORT")
        .capture_default_str();
    program.add_option("--pose", options->pose, "the daemon's pose socket")
        .type_name("PATH")
        .capture_default_str();
    program.add_option("--control", options->control, "the daemon's control socket")
        .type_name("PATH")
        .capture_default_str();
    program
        .add_option("--token-file", options->token_file,
                    "its first line is needed for everything that changes something")
        .type_name("FILE");
    program.add_flag("--private", options->is_private, "the token is needed for reading too");
    program.add_option("--maps", options->maps, "folder of maps that the page lists and saves")
        .type_name("DIR");
    program
        .add_option("--allow-origin", options->allowed_origins,
                    "a site whose pages may use this one, such as https://app.example.org")
        .type_name("ORIGIN")
        .one_word();
    program
        .add_option("--broker", options->fleet.broker,
                    "a fleet's MQTT broker: all its robots on /fleet.html")
        .type_name("HOST[:PORT]");
    program
        .add_option("--broker-config", options->fleet.config,
                    "broker (TLS, user, certificates) and site of a config of cornerd-mqtt")
        .type_name("FILE");
    program.add_option("--site", options->fleet.site, "the site of the fleet; default: default")
        .type_name("SITE");
    program.callback([options] { run(*options); });
  };
  return tool::run_program("cornerd-web", "shows in a browser what cornerd publishes", add, argc,
                           argv);
}

}  // namespace cornerd::web
