// SPDX-License-Identifier: MIT
#include <csignal>
#include <cstdio>
#include <exception>

#include <CLI/CLI.hpp>

#include "settings/config.hpp"
#include "tool/commands.hpp"
#include "tool/failure.hpp"

namespace {

using namespace cornerd;

int complain(const char* text, int exit_code) {
  std::fprintf(stderr, "cornerctl: %s\n", text);
  return exit_code;
}

}  // namespace

int main(int argc, char** argv) {
  // A reader that goes away is an error of write(), which ends the command as any other does.
  std::signal(SIGPIPE, SIG_IGN);

  CLI::App program("cornerctl: watch, record, replay, simulate and draw what cornerd does",
                   "cornerctl");
  program.set_version_flag("--version", "cornerctl " CORNERD_VERSION);
  program.require_subcommand(1);
  program.fallthrough();
  tool::add_watch(program);
  tool::add_replay(program);
  tool::add_detect(program);
  tool::add_record(program);
  tool::add_simulate(program);
  tool::add_map(program);

  try {
    program.parse(argc, argv);
    return tool::kExitDone;
  } catch (const CLI::ParseError& error) {
    return program.exit(error) == 0 ? tool::kExitDone : tool::kExitUsage;
  } catch (const tool::OutputClosed&) {
    return tool::kExitDone;
  } catch (const tool::UsageError& error) {
    return complain(error.what(), tool::kExitUsage);
  } catch (const settings::SettingsError& error) {
    return complain(error.what(), tool::kExitConfig);
  } catch (const std::exception& error) {
    return complain(error.what(), tool::kExitFailed);
  }
}
