// SPDX-License-Identifier: MIT
// What cornerd-bench measured, as tables for a person. What was not measured is left out.
#pragma once

#include <string>

#include "bench/program/report.hpp"

namespace cornerd::bench {

/// Time per turn and location, beside the paper's.
std::string time_table(const BenchReport& report);

/// True and false corners per location, beside the paper's.
std::string true_false_table(const BenchReport& report);

/// Position errors, beside the paper's.
std::string position_table(const BenchReport& report);

/// Instructions per turn and sample, over the number of samples.
std::string scaling_table(const BenchReport& report);

/// Precision, recall and error of the corners: a table for each circumstance.
std::string corner_tables(const BenchReport& report);

std::string bench_text(const BenchReport& report);

}  // namespace cornerd::bench
