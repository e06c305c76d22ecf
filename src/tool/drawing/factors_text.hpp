// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>

#include "calibration/factor_search.hpp"

namespace cornerd::tool {

/// The factors that the mode has, "0.812, 1.190"; one at an end of the search bears a star.
std::string describe_factors(core::HeadingSource source, const calibration::FoundFactors& found);

/// What the star means, a line of its own.
inline constexpr std::string_view kEdgeText =
    "* at an end of the search, 0 to 2.5: 0 leaves that sensor out, and at 2.5 the best lies "
    "beyond\n";

}  // namespace cornerd::tool
