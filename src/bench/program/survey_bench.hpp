// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>

namespace cornerd::bench {

struct SurveyBenchOptions {
  std::filesystem::path maps;   ///< folder with flat-7.json
  std::filesystem::path plots;  ///< folder to draw into; empty: none
  std::uint64_t seed = 1;
};

/// A simulated drive of 100 m, surveyed by both methods, on standard output.
void run_survey_bench(const SurveyBenchOptions& options);

}  // namespace cornerd::bench
