// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <string_view>

#include "core/localizer_config.hpp"

namespace cornerd::bench {

/// A corner detector with a name.
struct NamedMethod {
  std::string_view name;   ///< as on the command line
  std::string_view title;  ///< as in tables
  core::DetectorConfig config;
};

/// The three methods of the paper: altbd, abd-iepf, lt.
std::span<const NamedMethod> paper_methods();

/// Variants of them. To add one, add a line to the table in the .cpp.
std::span<const NamedMethod> variants();

/// Searches both lists; nullptr where the name is unknown.
const NamedMethod* find_method(std::string_view name);

}  // namespace cornerd::bench
