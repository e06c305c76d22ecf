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

/// The scores of all methods under one circumstance.
struct CornerReport {
  std::string circumstances;
  std::vector<MethodScore> scores;
};

/// Instructions that a method takes for a scan of so many samples, the mean over the 43 poses.
struct InstructionFigure {
  std::string method;  ///< its title
  std::size_t samples = 0;
  double per_scan = 0;
};

/// All that cornerd-bench measured.
struct BenchReport {
  std::size_t samples = 0;  ///< a scan
  std::size_t positions = 0;
  std::uint64_t seed = 0;

  PaperScans scans;
  std::vector<PaperResult> paper;
  std::vector<std::size_t> supported_corners;  ///< of each of the scans
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

/// Time per scan and location, beside the paper's.
std::string time_table(const BenchReport& report);

/// True and false corners per location, beside the paper's.
std::string true_false_table(const BenchReport& report);

/// Position errors, beside the paper's.
std::string position_table(const BenchReport& report);

/// Instructions per scan and sample, over the number of samples.
std::string scaling_table(const BenchReport& report);

/// Precision, recall and error of the corners: a table for each circumstance.
std::string corner_tables(const BenchReport& report);

std::string bench_text(const BenchReport& report);

/// What cornerd-bench measured, as one JSON object: metres, microseconds, shares.
std::string bench_json(const BenchReport& report);

/// The pictures of the paper's figures, drawn from what was measured, into a folder that is made
/// where it is missing: times.svg (figure 11), positions.svg (figure 15), and scan-METHOD.svg, one
/// scan with what each method finds in it (figures 9 and 10). Throws Failure.
void draw_bench(const BenchReport& report, const std::filesystem::path& folder);

/// What the scans are made of.
struct CountedScans {
  std::vector<std::shared_ptr<const core::WallMap>> maps;
  std::filesystem::path folder;  ///< of the maps
  replay::SensorModel sensor;
  std::uint64_t seed = 0;
};

/// Fills in the instructions that each method takes for a scan, for several numbers of samples: by
/// the processor's counter, else by valgrind as the difference between detecting once and twice,
/// so that nothing but the detection counts. Where there is neither, says so on standard error.
void count_instructions(const CountedScans& scans, std::span<const NamedMethod> methods,
                        BenchReport& report);

}  // namespace cornerd::bench
