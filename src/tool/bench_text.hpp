// SPDX-License-Identifier: MIT
// What cornerctl bench measured, as tables for a person.
#pragma once

#include <cstddef>
#include <span>
#include <string>

#include "bench/corner_experiment.hpp"

namespace cornerd::tool {

/// One circumstance: a line a method.
std::string corner_table(const std::string& title, std::span<const bench::MethodScore> scores);

/// What the columns of corner_table() are.
std::string corner_table_legend();

}  // namespace cornerd::tool
