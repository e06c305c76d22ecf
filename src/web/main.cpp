// SPDX-License-Identifier: MIT
#include <csignal>

#include "drivers/serial/file_descriptor.hpp"
#include "web/cornerd_web.hpp"

int main(int argc, char** argv) {
  cornerd::drivers::occupy_standard_streams();
  // A client that goes away is an error of its connection alone.
  std::signal(SIGPIPE, SIG_IGN);
  return cornerd::web::run_cornerd_web(argc, argv);
}
