// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>

namespace cornerd::bench {

struct OdometryBenchOptions {
  std::filesystem::path maps;   ///< folder with flat-7.json; empty: the installed one
  std::filesystem::path plots;  ///< folder; empty: no pictures
  std::string json;             ///< file, "-" or empty
  std::uint64_t seed = 1;
  std::size_t drives = 4;  ///< of each robot whose lidar is covered now and then
};

/// cornerd-bench --odometry: the paper's modes of odometry on its drives, as a table, as JSON and
/// drawn against the truth.
void run_odometry_bench(const OdometryBenchOptions& options);

}  // namespace cornerd::bench
