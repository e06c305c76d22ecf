// SPDX-License-Identifier: MIT
#include "tool/cornerctl.hpp"

#include "tool/command_line/command.hpp"
#include "tool/commands.hpp"

namespace cornerd::tool {

int run_cornerctl(int argc, const char* const* argv) {
  const auto add_commands = [](Command& program) {
    program.require_subcommand();
    add_watch(program);
    add_status(program);
    add_set_pose(program);
    add_relocalize(program);
    add_monitor(program);
    add_doctor(program);
    add_replay(program);
    add_detect(program);
    add_record(program);
    add_simulate(program);
    add_emulate(program);
    add_survey(program);
    add_fleet(program);
    add_send_drive(program);
    add_export(program);
    add_calibrate(program);
    add_map(program);
    program.add_renamed("bench", "cornerd-bench");
  };
  return run_program("cornerctl", "watch, record, replay, simulate and draw what cornerd does",
                     add_commands, argc, argv);
}

}  // namespace cornerd::tool
