// SPDX-License-Identifier: MIT
// daemon_soak [--scans N] [--seed N] [--only FAULT] [--pause S] [--longest S]: runs the daemon's
// loops through all faults, or one of them, faster than real time. Exit code 1 if a check fails.
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <optional>
#include <string>
#include <string_view>

#include "core/geometry/angle.hpp"
#include "message/line_writer.hpp"
#include "soak_run.hpp"

namespace {

using namespace cornerd;

std::optional<std::size_t> fault_of(std::string_view name) {
  const auto& names = soak::FaultPlan::kNames;
  const auto found = std::find(names.begin(), names.end(), name);
  if (found == names.end()) return std::nullopt;
  return found - names.begin();
}

void print(const soak::SoakReport& report) {
  const auto number = [](std::uint64_t value) { return static_cast<unsigned long long>(value); };
  std::printf("%llu scans, %.1f h, in %.0f s: %.0f times real time\n", number(report.scans),
              report.simulated_s / 3600, report.real_s, report.simulated_s / report.real_s);
  for (std::size_t i = 0; i < report.poses.size(); ++i) {
    const auto name = message::to_string(static_cast<core::PoseState>(i));
    std::printf("  %-20.*s %10llu\n", static_cast<int>(name.size()), name.data(),
                number(report.poses[i]));
  }
  std::printf("  %-20s %10llu (worst errors of all: %.3f m, %.1f degrees)\n", "wrong",
              number(report.wrong), report.worst_error_m, core::degrees(report.worst_error_rad));
  for (std::size_t i = 0; i < report.faults.size(); ++i) {
    std::printf("  %-20.*s %10llu times\n", static_cast<int>(soak::FaultPlan::kNames[i].size()),
                soak::FaultPlan::kNames[i].data(), number(report.faults[i]));
  }
  std::printf("  bytes %llu = used %llu + skipped %llu; read from the port %llu\n",
              number(report.counters.bytes), number(report.counters.used_bytes),
              number(report.counters.skipped_bytes), number(report.read_bytes));
  std::printf("  heap %llu kB after a tenth, %llu kB at the end\n",
              number(report.warm_bytes / 1024), number(report.end_bytes / 1024));
  std::printf("  longest time without progress of both loops: %.2f s\n",
              report.max_without_progress_s);
}

}  // namespace

int main(int argc, char** argv) {
  soak::SoakConfig config;
  for (int i = 1; i + 1 < argc; i += 2) {
    const std::string_view name = argv[i];
    if (name == "--scans") {
      config.scans = std::strtoull(argv[i + 1], nullptr, 10);
    } else if (name == "--seed") {
      config.seed = std::strtoull(argv[i + 1], nullptr, 10);
    } else if (name == "--only" && fault_of(argv[i + 1])) {
      config.faults.only = fault_of(argv[i + 1]);
    } else if (name == "--pause") {
      config.faults.mean_pause_s = std::strtod(argv[i + 1], nullptr);
    } else if (name == "--longest") {
      config.faults.max_duration_s = std::strtod(argv[i + 1], nullptr);
    } else {
      std::fprintf(stderr,
                   "daemon_soak [--scans N] [--seed N] [--only FAULT] [--pause S] [--longest S]\n");
      return 2;
    }
  }
  config.on_wrong = [](const std::string& text) {
    std::printf("wrong: %s\n", text.c_str());
    std::fflush(stdout);
  };
  const soak::SoakReport report = soak::run(config);
  print(report);
  const auto failures = report.failures(config);
  for (const auto& failure : failures) std::printf("FAILED: %s\n", failure.c_str());
  return failures.empty() ? 0 : 1;
}
