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

/// Median time of each of `count` tasks. The tasks are interleaved, since repeating one would train
/// the branch predictor.
template <typename Task>
std::vector<double> median_times_us(std::size_t count, std::size_t repeats, Task&& task) {
  std::vector<std::vector<double>> times_us(count);
  for (std::size_t round = 0; round < repeats; ++round) {
    for (std::size_t i = 0; i < count; ++i) {
      const double start_us = cpu_time_us();
      task(i);
      times_us[i].push_back(cpu_time_us() - start_us);
    }
  }
  std::vector<double> medians_us;
  for (std::vector<double>& times : times_us) {
    std::sort(times.begin(), times.end());
    medians_us.push_back(quantile(times, 0.5));
  }
  return medians_us;
}

void prepare(const core::Scan& scan, core::PolarScan& points) {
  const core::LocalizerConfig limits;
  points.assign(scan, limits.min_range_m, limits.max_range_m);
}

}  // namespace

Workload::Workload(const NamedMethod& method, std::span<const core::Scan> scans)
    : detector_(method.config, core::LocalizerConfig{}.noise), points_(scans.size()) {
  for (std::size_t i = 0; i < scans.size(); ++i) prepare(scans[i], points_[i]);
}

void Workload::run(std::size_t scan) { detector_.detect(points_[scan], detection_); }

void Workload::run_all() {
  for (std::size_t i = 0; i < scans(); ++i) run(i);
}

std::vector<double> time_scans_us(Workload& workload, std::size_t repeats) {
  return median_times_us(workload.scans(), repeats, [&](std::size_t i) { workload.run(i); });
}

double time_preparation_us(std::span<const core::Scan> scans, std::size_t repeats) {
  core::PolarScan points;
  return mean_and_deviation(median_times_us(scans.size(), repeats,
                                            [&](std::size_t i) { prepare(scans[i], points); }))
      .mean;
}

}  // namespace cornerd::bench
