// SPDX-License-Identifier: MIT
#include <cstdio>
#include <optional>
#include <set>
#include <string>

#include "bench/instruction_counter.hpp"
#include "bench/program/benches.hpp"
#include "bench/program/report.hpp"
#include "bench/workload.hpp"
#include "tool/command_line/progress_bar.hpp"

namespace cornerd::bench {

namespace {

/// An A1's scans have 270 to 1,450 samples; larger ones show how the cost grows.
const std::set<std::size_t> kCountedSizes = {400, 800, 1450, 2900, 5800, 10'000};

/// One detection in each of the scans.
std::optional<double> count_by_processor(InstructionCounter& counter, const CountedScans& scans,
                                         const NamedMethod& method, std::size_t samples) {
  const auto simulated = simulate_paper_scans(scans.maps, scans.sensor, samples, scans.seed);
  Workload workload(method, simulated.scans);
  workload.run_all();
  const auto count = counter.count([&] { workload.run_all(); });
  if (!count) return std::nullopt;
  return static_cast<double>(*count) / static_cast<double>(workload.scans());
}

std::optional<double> count_by_valgrind(const CountedScans& scans, const NamedMethod& method,
                                        std::size_t samples, std::size_t poses) {
  const auto count = [&](int times) {
    return count_by_callgrind({"--maps", scans.folder.string(), "--methods",
                               std::string(method.name), "--samples", std::to_string(samples),
                               "--seed", std::to_string(scans.seed), "--only-detect",
                               std::to_string(times)});
  };
  const auto once = count(1);
  const auto twice = once ? count(2) : std::nullopt;
  if (!twice || *twice < *once) return std::nullopt;
  return static_cast<double>(*twice - *once) / static_cast<double>(poses);
}

}  // namespace

void count_instructions(const CountedScans& scans, std::span<const NamedMethod> methods,
                        BenchReport& report) {
  InstructionCounter counter;
  std::set<std::size_t> sizes = kCountedSizes;
  sizes.insert(report.samples);
  tool::ProgressBar bar("instructions", sizes.size() * methods.size());
  std::size_t done = 0;
  for (const std::size_t samples : sizes) {
    for (const NamedMethod& method : methods) {
      const auto count = counter.is_available()
                             ? count_by_processor(counter, scans, method, samples)
                             : count_by_valgrind(scans, method, samples, report.scans.poses.size());
      if (!count) {
        std::fputs(kNotCounted, stderr);
        report.instructions.clear();
        return;
      }
      report.instructions.push_back({std::string(method.title), samples, *count});
      bar.show(++done);
    }
  }
  report.counter = counter.is_available() ? "the processor" : "valgrind";
}

}  // namespace cornerd::bench
