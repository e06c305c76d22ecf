// SPDX-License-Identifier: MIT
// Input and output of a survey.
#pragma once

#include <filesystem>
#include <span>
#include <string>

#include "replay/recording.hpp"
#include "survey/plan_refinement.hpp"
#include "survey/survey.hpp"

namespace cornerd::tool {

/// Consecutive recordings as one drive. Shifts the times of a recording whose clock restarts.
/// `odometry`: a file of ODOMETRY lines, or empty. Reports skipped lines on standard error. Throws
/// replay::RecordingError and Failure.
survey::RecordedDrive load_drive(std::span<const std::filesystem::path> files,
                                 const replay::RecordingOptions& options,
                                 const std::filesystem::path& odometry);

/// A --truth file: a line for each scan.
std::string trajectory_text(const survey::SurveyResult& result);

/// The report: walls, residuals, warnings, and what was dropped and why.
std::string survey_report(const survey::SurveyResult& result);

/// Which walls of the plan moved, which were not seen, and which are not there or new.
std::string refined_plan_report(const core::FloorPlan& drawn, const survey::RefinedPlan& refined);

}  // namespace cornerd::tool
