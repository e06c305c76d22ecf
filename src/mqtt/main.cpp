// SPDX-License-Identifier: MIT
#include <csignal>

#include "drivers/serial/file_descriptor.hpp"
#include "mqtt/cornerd_mqtt.hpp"

int main(int argc, char** argv) {
  cornerd::drivers::occupy_standard_streams();
  // A broker that goes away is an error of its connection alone.
  std::signal(SIGPIPE, SIG_IGN);
  return cornerd::mqtt::run_cornerd_mqtt(argc, argv);
}
