// SPDX-License-Identifier: MIT
#include "tool/cornerctl.hpp"

#include <cstdio>
#include <exception>
#include <string>

#include <CLI/CLI.hpp>

#include "settings/config.hpp"
#include "tool/command_line/failure.hpp"
#include "tool/commands.hpp"

namespace cornerd::tool {

namespace {

int complain(const char* text, int exit_code) {
  std::fprintf(stderr, "cornerctl: %s\n", text);
  return exit_code;
}

}  // namespace

int run_cornerctl(int argc, const char* const* argv) {
  CLI::App program("cornerctl: watch, record, replay, simulate and draw what cornerd does",
                   "cornerctl");
  program.set_version_flag("--version", "cornerctl " CORNERD_VERSION);
  program.require_subcommand(1);
  program.fallthrough();
  add_watch(program);
  add_monitor(program);
  add_doctor(program);
  add_replay(program);
  add_detect(program);
  add_record(program);
  add_simulate(program);
  add_emulate(program);
  add_survey(program);
  add_calibrate(program);
  add_map(program);

  try {
    const std::string first = argc > 1 ? argv[1] : "";
    if (!first.empty() && first.front() != '-' &&
        program.get_subcommands([&](CLI::App* one) { return one->get_name() == first; }).empty()) {
      throw UsageError("there is no command \"" + first + "\"; cornerctl --help lists them");
    }
    program.parse(argc, argv);
    return kExitDone;
  } catch (const CLI::ParseError& error) {
    return program.exit(error) == 0 ? kExitDone : kExitUsage;
  } catch (const OutputClosed&) {
    return kExitDone;
  } catch (const UsageError& error) {
    return complain(error.what(), kExitUsage);
  } catch (const settings::SettingsError& error) {
    return complain(error.what(), kExitConfig);
  } catch (const std::exception& error) {
    return complain(error.what(), kExitFailed);
  }
}

}  // namespace cornerd::tool
