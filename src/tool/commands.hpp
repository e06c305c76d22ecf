// SPDX-License-Identifier: MIT
// The subcommands of cornerctl, a file for each. Each function adds its command to the program; the
// command runs inside the parse, and throws what it cannot do (see failure.hpp).
#pragma once

namespace CLI {
class App;
}

namespace cornerd::tool {

void add_watch(CLI::App& program);
void add_doctor(CLI::App& program);
void add_monitor(CLI::App& program);
void add_replay(CLI::App& program);
void add_detect(CLI::App& program);
void add_record(CLI::App& program);
void add_simulate(CLI::App& program);
void add_emulate(CLI::App& program);
void add_survey(CLI::App& program);
void add_calibrate(CLI::App& program);
void add_map(CLI::App& program);

}  // namespace cornerd::tool
