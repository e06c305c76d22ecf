// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "tool/monitor/frame.hpp"
#include "tool/monitor/monitor_state.hpp"

namespace cornerd::tool {

/// What is wrong, most urgent first and alone, and what to do about it.
struct Advice {
  Style style = Style::kGood;  ///< kBad: no pose can come; kWarning: poses are fewer or worse
  std::string what;
  std::string mend;  ///< empty: wait
};

Advice advise(const MonitorState& state, core::TimeNs now_ns);

}  // namespace cornerd::tool
