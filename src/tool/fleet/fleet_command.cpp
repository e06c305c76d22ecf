// SPDX-License-Identifier: MIT
// cornerctl fleet: a live table of a site's robots.
#include <unistd.h>

#include <chrono>
#include <memory>
#include <string>

#include "core/geometry/angle.hpp"
#include "mqtt/fleet.hpp"
#include "settings/config.hpp"
#include "tool/command_line/command.hpp"
#include "tool/command_line/output.hpp"
#include "tool/command_line/stop_signal.hpp"
#include "tool/commands.hpp"
#include "tool/drawing/text_table.hpp"
#include "tool/fleet/broker_options.hpp"

namespace cornerd::tool {

namespace {

constexpr std::chrono::milliseconds kCollectTime{1000};
constexpr std::chrono::milliseconds kRefresh{500};

struct FleetOptions {
  BrokerOptions broker;
  bool is_once = false;
};

double steady_s() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

std::string age_text(double age_s) {
  if (age_s < 120) return formatted("%.0f s", age_s);
  return age_s < 7200 ? formatted("%.0f min", age_s / 60) : formatted("%.0f h", age_s / 3600);
}

/// Names come from the network, and a terminal obeys control characters.
std::string table(const mqtt::Fleet& fleet) {
  TextTable rows;
  rows.add_row({"robot", "state", "room", "x [m]", "y [m]", "theta [deg]", "map", "version", "age",
                "problem"});
  for (const mqtt::Fleet::Robot& robot : fleet.robots(steady_s())) {
    const mqtt::RobotReport& report = robot.report;
    std::vector<std::string> row = {report.manufacturer + "/" + report.serial, report.state,
                                    report.room};
    if (const auto& pose = report.T_map_base) {
      row.insert(row.end(), {formatted("%.2f", pose->x_m), formatted("%.2f", pose->y_m),
                             formatted("%.0f", core::degrees(pose->theta_rad))});
    } else {
      row.insert(row.end(), {"", "", ""});
    }
    row.insert(row.end(),
               {report.map, report.map_version == 0 ? "" : std::to_string(report.map_version),
                age_text(robot.age_s), report.problem});
    for (std::string& cell : row) cell = settings::one_line(cell);
    rows.add_row(std::move(row));
  }
  return rows.text();
}

void show(const FleetOptions& options) {
  const StopSignal stop;  // before the broker's thread
  mqtt::Fleet fleet(options.broker.site());
  mqtt::Broker broker(options.broker.broker());
  const auto take = [&](const mqtt::Message& message) {
    fleet.take(message, steady_s(), std::chrono::system_clock::now());
  };
  broker.subscribe(fleet.filter());
  wait_for_connection(broker);
  Output output(/*flush_each=*/true);
  if (options.is_once || ::isatty(STDOUT_FILENO) == 0) {
    // Robots that drive report once a second: silence may never come.
    const auto until = std::chrono::steady_clock::now() + kCollectTime;
    while (std::chrono::steady_clock::now() < until && !stop.wait(std::chrono::milliseconds(50))) {
      for (const mqtt::Message& message : broker.take()) take(message);
    }
    return output.write(table(fleet));
  }
  while (!stop.wait(kRefresh)) {
    for (const mqtt::Message& message : broker.take()) take(message);
    // Home, the table with the rest of each line cleared, and the rest of the screen.
    std::string screen = "\033[H";
    for (const char c : table(fleet)) c == '\n' ? screen += "\033[K\n" : screen += c;
    if (!broker.is_connected()) screen += "no broker: " + broker.problem() + "\033[K\n";
    output.write(screen + "\033[J");
  }
}

}  // namespace

void add_fleet(Command& program) {
  Command command = program.add_subcommand("fleet", "a live table of the robots of a site");
  const auto options = std::make_shared<FleetOptions>();
  options->broker.add(command);
  command.add_flag("--once", options->is_once, "the table once, as it is without a terminal");
  command.callback([options] { show(*options); });
}

}  // namespace cornerd::tool
