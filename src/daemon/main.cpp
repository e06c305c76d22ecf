// SPDX-License-Identifier: MIT
#include <poll.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <memory>
#include <new>
#include <span>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>

#include "daemon/daemon.hpp"
#include "daemon/daemon_options.hpp"
#include "daemon/event_loop.hpp"
#include "daemon/lidar_factory.hpp"
#include "daemon/log.hpp"
#include "daemon/map_loader.hpp"
#include "daemon/realtime.hpp"
#include "drivers/config/open_files.hpp"
#include "drivers/serial/file_descriptor.hpp"
#include "settings/config.hpp"

namespace {

using namespace cornerd;

constexpr int kExitFailed = 1;
constexpr int kExitUsage = 2;

/// Waits at most 1 s for a reader of standard error.
void print_error(const std::string& what) {
  constexpr int kTimeoutMs = 1000;
  pollfd stream{.fd = STDERR_FILENO, .events = POLLOUT, .revents = 0};
  if (::poll(&stream, 1, kTimeoutMs) > 0) std::fprintf(stderr, "cornerd: %s\n", what.c_str());
}

void print(std::string_view text) {
  if (std::fwrite(text.data(), 1, text.size(), stdout) == text.size() && std::fflush(stdout) == 0) {
    return;
  }
  // The reader, such as `head`, has closed the pipe.
  if (errno == EPIPE) return;
  throw std::system_error(errno, std::generic_category(), "standard output");
}

int run(const daemon::Options& options) {
  if (options.help) {
    print(daemon::kHelp);
    return 0;
  }
  if (options.version) {
    print("cornerd " CORNERD_VERSION "\n");
    return 0;
  }
  if (options.check) {
    for (const std::string& warning :
         daemon::MapLoader(options.config, options.overrides).check()) {
      print_error("warning: " + warning);
    }
    print("ok\n");
    return 0;
  }
  daemon::set_up_log();
  daemon::use_small_stacks();
  // While a large map loads there is nothing to end in an orderly way; the event loop takes over.
  for (const int signal : {SIGTERM, SIGINT}) std::signal(signal, [](int) { std::_Exit(0); });
  daemon::MapLoader loader(options.config, options.overrides);
  daemon::Loaded loaded = loader.load();
  auto lidar = daemon::make_lidar(loaded.config.lidar);
  // On the heap: its 36 kB do not fit on a small stack (ulimit -s 64).
  std::make_unique<daemon::Daemon>(std::move(loaded), std::move(loader), std::move(lidar),
                                   CORNERD_VERSION)
      ->run();
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  daemon::block_reloads();
  drivers::occupy_standard_streams();
  // A closed log must not end the daemon.
  std::signal(SIGPIPE, SIG_IGN);
  // Nor a limit of file sizes: the write fails, and its caller says so.
  std::signal(SIGXFSZ, SIG_IGN);
  // Sent by what rotates logs and the like, for other daemons.
  for (const int signal : {SIGUSR1, SIGUSR2, SIGALRM}) std::signal(signal, SIG_IGN);
  try {
    const std::span<const char* const> arguments(argv, static_cast<std::size_t>(argc));
    return run(daemon::parse_options(arguments.subspan(argc > 0 ? 1 : 0)));
  } catch (const daemon::UsageError& error) {
    print_error(std::string(error.what()) + "\nsee cornerd --help");
    return kExitUsage;
  } catch (const settings::SettingsError& error) {
    print_error(error.what());
    return settings::kExitConfig;
  } catch (const std::bad_alloc&) {
    print_error("not enough memory: check `ulimit -v` and the size of the map");
    return kExitFailed;
  } catch (const std::system_error& error) {
    print_error(error.what() + drivers::open_files_hint(error.code().value()));
    return kExitFailed;
  } catch (const std::exception& error) {
    print_error(error.what());
    return kExitFailed;
  }
}
