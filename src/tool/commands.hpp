// SPDX-License-Identifier: MIT
// The commands of cornerctl. Each function adds its command to the program or to a group of
// commands. The command runs inside the parse and throws the exceptions of failure.hpp.
#pragma once

namespace cornerd::tool {

class Command;

void add_watch(Command& program);
void add_status(Command& program);
void add_set_pose(Command& program);
void add_relocalize(Command& program);
void add_monitor(Command& program);
void add_doctor(Command& program);
void add_replay(Command& program);
void add_detect(Command& program);
void add_record(Command& program);
void add_simulate(Command& program);
void add_emulate(Command& program);
void add_survey(Command& program);
void add_fleet(Command& program);
void add_send_drive(Command& program);
void add_export(Command& program);

void add_calibrate(Command& program);
void add_calibrate_bias(Command& group);
void add_calibrate_mount(Command& group);
void add_calibrate_odometry(Command& group);

void add_map(Command& program);
void add_map_render(Command& group);
void add_map_import(Command& group);
void add_map_export(Command& group);
void add_map_learned(Command& group);
void add_map_scale(Command& group);
void add_map_diff(Command& group);
void add_map_publish(Command& group);

}  // namespace cornerd::tool
