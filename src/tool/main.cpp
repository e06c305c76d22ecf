// SPDX-License-Identifier: MIT
#include <csignal>

#include "drivers/serial/file_descriptor.hpp"
#include "tool/cornerctl.hpp"

int main(int argc, char** argv) {
  cornerd::drivers::occupy_standard_streams();
  // A reader that goes away is an error of write(), which ends the command as any other does.
  std::signal(SIGPIPE, SIG_IGN);
  return cornerd::tool::run_cornerctl(argc, argv);
}
