// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "bench/corner_experiment.hpp"
#include "bench/paper_experiment.hpp"

namespace cornerd::bench {

/// The scores of all methods under one circumstance.
struct CornerReport {
  std::string circumstances;
  std::vector<MethodScore> scores;
};

/// Instructions that a method takes for a turn of so many samples, the mean over the 43 places.
struct InstructionFigure {
  std::string method;  ///< its title
  std::size_t samples = 0;
  double per_scan = 0;
};

/// All that cornerd-bench measured.
struct BenchReport {
  std::size_t samples = 0;  ///< a turn
  std::size_t positions = 0;
  std::uint64_t seed = 0;

  PaperScans scans;
  std::vector<PaperResult> paper;
  std::vector<std::size_t> supported_corners;  ///< of each of the turns
  double preparation_us = 0;

  std::string counter;  ///< what counted instructions; empty: nothing
  std::vector<InstructionFigure> instructions;
  std::vector<CornerReport> corners;

  std::optional<double> instructions_of(std::string_view method,
                                        std::size_t samples_per_scan) const {
    for (const InstructionFigure& figure : instructions) {
      if (figure.method == method && figure.samples == samples_per_scan) return figure.per_scan;
    }
    return std::nullopt;
  }
};

}  // namespace cornerd::bench
