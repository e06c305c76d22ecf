// SPDX-License-Identifier: MIT
// What a survey reads and writes.
#pragma once

#include <filesystem>
#include <span>
#include <string>

#include "replay/recording.hpp"
#include "survey/survey.hpp"

namespace cornerd::tool {

/// Recordings, one after another, as one drive. The times of one whose clock begins before the end
/// of the one before it are set on, so that it follows. `odometry`: of another file, or empty. What
/// was passed over is said on standard error. Throws replay::RecordingError and Failure.
survey::RecordedDrive load_drive(std::span<const std::filesystem::path> files,
                                 const replay::RecordingOptions& options,
                                 const std::filesystem::path& odometry);

/// A --truth file: a line for each scan.
std::string trajectory_text(const survey::SurveyResult& result);

/// For people: what was found, what was dropped and why.
std::string survey_report(const survey::SurveyResult& result);

}  // namespace cornerd::tool
