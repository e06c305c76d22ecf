// SPDX-License-Identifier: MIT
#include <csignal>
#include <cstdio>
#include <exception>
#include <memory>
#include <span>
#include <utility>

#include "daemon/daemon.hpp"
#include "daemon/lidar_factory.hpp"
#include "daemon/log.hpp"
#include "daemon/options.hpp"
#include "daemon/realtime.hpp"
#include "daemon/reloader.hpp"
#include "drivers/serial/standard_streams.hpp"
#include "settings/config.hpp"
#include "settings/map_file.hpp"

namespace {

using namespace cornerd;

constexpr int kExitFailed = 1;
constexpr int kExitUsage = 2;

void complain(const char* what) { std::fprintf(stderr, "cornerd: %s\n", what); }

int run(const daemon::Options& options) {
  if (options.help) {
    std::fwrite(daemon::kHelp.data(), 1, daemon::kHelp.size(), stdout);
    return 0;
  }
  if (options.version) {
    std::puts("cornerd " CORNERD_VERSION);
    return 0;
  }
  if (options.check) {
    settings::load_map(settings::load_config(options.config, options.overrides).map);
    std::puts("ok");
    return 0;
  }
  daemon::set_up_log();
  daemon::use_small_stacks();
  const auto load = [&options] {
    daemon::Loaded loaded;
    loaded.config = settings::load_config(options.config, options.overrides);
    loaded.map = settings::load_map(loaded.config.map);
    loaded.pipeline = std::make_unique<core::Pipeline>(loaded.map, loaded.config.localizer());
    return loaded;
  };
  daemon::Loaded loaded = load();
  auto lidar = daemon::make_lidar(loaded.config.lidar);
  daemon::Daemon(std::move(loaded), load, std::move(lidar), CORNERD_VERSION).run();
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  drivers::occupy_standard_streams();
  // Whoever read the log is gone: no reason to follow.
  std::signal(SIGPIPE, SIG_IGN);
  try {
    const std::span<const char* const> arguments(argv, static_cast<std::size_t>(argc));
    return run(daemon::parse_options(arguments.subspan(argc > 0 ? 1 : 0)));
  } catch (const daemon::UsageError& error) {
    complain(error.what());
    std::fputs("cornerd --help says more\n", stderr);
    return kExitUsage;
  } catch (const settings::SettingsError& error) {
    complain(error.what());
    return settings::kExitConfig;
  } catch (const std::exception& error) {
    complain(error.what());
    return kExitFailed;
  }
}
