// SPDX-License-Identifier: MIT
#include "message/state_names.hpp"

namespace cornerd::message {

std::string_view to_string(core::PoseState state) {
  switch (state) {
    case core::PoseState::kFix:
      return "fix";
    case core::PoseState::kTracking:
      return "tracking";
    case core::PoseState::kPredicted:
      return "predicted";
    case core::PoseState::kAmbiguous:
      return "ambiguous";
    case core::PoseState::kLost:
      return "lost";
  }
  return "lost";
}

std::string_view to_string(core::BreakpointKind kind) {
  return kind == core::BreakpointKind::kCorner ? "corner" : "terminal";
}

}  // namespace cornerd::message
