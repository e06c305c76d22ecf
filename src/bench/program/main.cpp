// SPDX-License-Identifier: MIT
#include <csignal>

#include "bench/program/cornerd_bench.hpp"
#include "drivers/serial/file_descriptor.hpp"

int main(int argc, char** argv) {
  cornerd::drivers::occupy_standard_streams();
  // A closed reader is then an error of write(), handled as any other.
  std::signal(SIGPIPE, SIG_IGN);
  return cornerd::bench::run_cornerd_bench(argc, argv);
}
