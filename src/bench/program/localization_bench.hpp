// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>

namespace cornerd::bench {

struct LocalizationBenchOptions {
  std::filesystem::path maps;  ///< folder of the contest arena's layouts and of flat-7.json
  std::size_t places = 1000;   ///< in each trial
  std::uint64_t seed = 1;
  bool instructions = false;
  std::string json;  ///< file, "-" or empty
};

/// cornerd-bench --localizer: precision, honesty, adversity, motion, kidnapping and cost.
void run_localization_bench(const LocalizationBenchOptions& options);

/// What valgrind is started on: localizes in `turns` turns and says nothing. `tracking`: with what
/// the turns before told, else each without.
void only_localize_in_arena(const LocalizationBenchOptions& options, std::size_t scans,
                            bool tracking);

}  // namespace cornerd::bench
