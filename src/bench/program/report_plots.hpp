// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>

#include "bench/program/report.hpp"

namespace cornerd::bench {

/// The pictures of the paper's figures, drawn from what was measured, into a folder that is made
/// where it is missing: times.svg (figure 11), positions.svg (figure 15), and turn-METHOD.svg, one
/// turn with what each method finds in it (figures 9 and 10). Throws Failure.
void draw_bench(const BenchReport& report, const std::filesystem::path& folder);

}  // namespace cornerd::bench
