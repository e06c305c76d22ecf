// SPDX-License-Identifier: MIT
// How the messages call what the core counts by number.
#pragma once

#include <string_view>

#include "core/breakpoint/breakpoint.hpp"
#include "core/pose_estimate.hpp"

namespace cornerd::message {

std::string_view to_string(core::PoseState state);
std::string_view to_string(core::BreakpointKind kind);

}  // namespace cornerd::message
