// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "tool/bench_report.hpp"

namespace cornerd::tool {

/// What cornerctl bench measured, as one JSON object: metres, microseconds, shares.
std::string bench_json(const BenchReport& report);

}  // namespace cornerd::tool
