// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "survey/survey.hpp"

namespace cornerd::tool {

/// Walls, points, trajectory and walls without observations, as SVG.
std::string survey_drawing(const survey::SurveyResult& result);

/// The drawing of Bertocco et al.: 1024 x 1024 pixels, points in grey, fitted lines in blue.
std::string ransac_canvas(const survey::SurveyResult& result);

}  // namespace cornerd::tool
