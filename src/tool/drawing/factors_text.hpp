// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>

#include "calibration/factor_search.hpp"

namespace cornerd::tool {

/// The factors of the mode, "0.812, 1.190", with a star at a limit of the search.
std::string describe_factors(calibration::HeadingSource source,
                             const calibration::FoundFactors& found);

/// The footnote of the star, one line.
inline constexpr std::string_view kEdgeText =
    "* at a limit of the search, 0 to 2.5: at 0 the sensor is not used, at 2.5 the optimum is "
    "larger\n";

}  // namespace cornerd::tool
