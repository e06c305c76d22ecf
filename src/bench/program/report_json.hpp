// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "bench/program/report.hpp"

namespace cornerd::bench {

/// What cornerd-bench measured, as one JSON object: metres, microseconds, shares.
std::string bench_json(const BenchReport& report);

}  // namespace cornerd::bench
