// SPDX-License-Identifier: MIT
#include "bench/workload.hpp"

#include <time.h>

#include <algorithm>

#include "bench/statistics.hpp"

namespace cornerd::bench {
namespace {

double cpu_time_us() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) * 1e6 + static_cast<double>(now.tv_nsec) * 1e-3;
}

template <typename Task>
double median_time_us(std::size_t repeats, Task&& task) {
  std::vector<double> times_us;
  for (std::size_t i = 0; i < repeats; ++i) {
    const double start_us = cpu_time_us();
    task();
    times_us.push_back(cpu_time_us() - start_us);
  }
  std::sort(times_us.begin(), times_us.end());
  return quantile(times_us, 0.5);
}

void prepare(const core::Scan& turn, core::PolarScan& points) {
  const core::LocalizerConfig limits;
  points.assign(turn, limits.min_range_m, limits.max_range_m);
}

}  // namespace

Workload::Workload(const NamedMethod& method, std::span<const core::Scan> turns)
    : detector_(method.config, core::LocalizerConfig{}.noise), points_(turns.size()) {
  for (std::size_t i = 0; i < turns.size(); ++i) prepare(turns[i], points_[i]);
}

void Workload::run(std::size_t turn) { detector_.detect(points_[turn], detection_); }

void Workload::run_all() {
  for (std::size_t i = 0; i < turns(); ++i) run(i);
}

std::vector<double> time_turns_us(Workload& workload, std::size_t repeats) {
  workload.run_all();  // caches and branch predictors warm up
  std::vector<double> times_us;
  for (std::size_t i = 0; i < workload.turns(); ++i) {
    times_us.push_back(median_time_us(repeats, [&] { workload.run(i); }));
  }
  return times_us;
}

double time_preparation_us(std::span<const core::Scan> turns, std::size_t repeats) {
  core::PolarScan points;
  std::vector<double> times_us;
  for (const core::Scan& turn : turns) {
    times_us.push_back(median_time_us(repeats, [&] { prepare(turn, points); }));
  }
  return mean_and_spread(times_us).mean;
}

}  // namespace cornerd::bench
