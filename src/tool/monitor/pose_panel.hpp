// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "tool/monitor/frame.hpp"
#include "tool/monitor/monitor_state.hpp"

namespace cornerd::tool {

struct PanelLine {
  std::string text;
  Style style = Style::kPlain;
};

/// Pose, rates, lidar and events in words, the most important first, in lines of about 31
/// characters.
std::vector<PanelLine> panel_lines(const MonitorState& state, core::TimeNs now_ns);

/// "3 s", "5 min", "2 h"
std::string age_text(double seconds);

/// "fix" in the state's colour; "stale fix" if no pose has followed.
PanelLine state_line(const MonitorState& state, core::TimeNs now_ns);

}  // namespace cornerd::tool
