// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "bench/corner_experiment.hpp"
#include "bench/methods.hpp"
#include "bench/paper_experiment.hpp"
#include "bench/program/report.hpp"
#include "replay/simulator/sensor_model.hpp"

namespace cornerd::bench {

/// The scores of all methods for one sensor and noise.
struct CornerReport {
  std::string conditions;
  std::vector<MethodScore> scores;
};

/// Mean instructions of a method per scan of `samples` samples, over the 43 poses.
struct InstructionFigure {
  std::string method;  ///< its title
  std::size_t samples = 0;
  double per_scan = 0;
};

/// The measurements of cornerd-bench.
struct BenchReport {
  std::size_t samples = 0;  ///< per scan
  std::size_t positions = 0;
  std::uint64_t seed = 0;

  PaperScans scans;
  std::vector<PaperResult> paper;
  std::vector<std::size_t> supported_corners;  ///< of each scan
  double preparation_us = 0;

  std::string counter;  ///< of instructions; empty: none
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

/// Time per scan and location, with the paper's.
std::string time_table(const BenchReport& report);

/// True and false corners per location, with the paper's.
std::string true_false_table(const BenchReport& report);

/// Position errors, with the paper's.
std::string position_table(const BenchReport& report);

/// Instructions per scan and per sample, by the number of samples.
std::string scaling_table(const BenchReport& report);

/// Precision, recall and error of the corners: a table for each sensor and noise.
std::string corner_tables(const BenchReport& report);

std::string bench_text(const BenchReport& report);

/// The report as one JSON object: metres, microseconds, shares.
std::string bench_json(const BenchReport& report);

/// Draws the paper's figures with the measured values: times.svg (figure 11), positions.svg (figure
/// 15), and scan-METHOD.svg, one scan with each method's breakpoints (figures 9 and 10). Creates
/// the folder if it is missing. Throws Failure.
void draw_bench(const BenchReport& report, const std::filesystem::path& folder);

/// Input of the simulated scans.
struct CountedScans {
  std::vector<std::shared_ptr<const core::WallMap>> maps;
  std::filesystem::path folder;  ///< of the maps
  replay::SensorModel sensor;
  std::uint64_t seed = 0;
};

/// Counts each method's instructions per scan, for several numbers of samples: by the processor's
/// counter, else by valgrind. The difference of two runs with one and two detections excludes the
/// rest of the program. Without either, reports it on standard error.
void count_instructions(const CountedScans& scans, std::span<const NamedMethod> methods,
                        BenchReport& report);

}  // namespace cornerd::bench
