// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <string_view>

#include "core/localizer_config.hpp"

namespace cornerd::bench {

/// A way to find corners that is measured under a name.
struct NamedMethod {
  std::string_view name;   ///< as on the command line
  std::string_view title;  ///< as in tables
  core::DetectorConfig config;
};

/// The three that the paper compares: altbd, abd-iepf, lt.
std::span<const NamedMethod> paper_methods();

/// Other forms of them. To add one, add a line to the table.
std::span<const NamedMethod> variants();

/// Among both; null where there is none of that name.
const NamedMethod* find_method(std::string_view name);

}  // namespace cornerd::bench
