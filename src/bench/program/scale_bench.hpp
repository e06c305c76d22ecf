// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace cornerd::bench {

struct ScaleBenchOptions {
  std::vector<std::size_t> corners = {20, 200, 2000, 20'000};
  std::size_t scans = 200;
  std::uint64_t seed = 1;
  bool instructions = false;
  std::filesystem::path plots;  ///< folder; empty: no picture
  std::string json;             ///< file, "-" or empty
};

/// cornerd-bench --scale: the first fix in buildings of several sizes, as a table, as JSON and as
/// a picture.
void run_scale_bench(const ScaleBenchOptions& options);

/// What valgrind is started on: localizes `times` in each turn and says nothing.
void only_localize(const ScaleBenchOptions& options, std::size_t times);

}  // namespace cornerd::bench
