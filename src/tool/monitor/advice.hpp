// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "tool/monitor/frame.hpp"
#include "tool/monitor/monitor_state.hpp"

namespace cornerd::tool {

/// The most urgent fault and its remedy.
struct Advice {
  Style style = Style::kGood;  ///< kBad: no pose is possible; kWarning: poses are fewer or worse
  std::string what;
  std::string mend;  ///< empty: wait
};

Advice advise(const MonitorState& state, core::TimeNs now_ns);

}  // namespace cornerd::tool
