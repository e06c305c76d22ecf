// SPDX-License-Identifier: MIT
#pragma once

#include "tool/monitor/frame.hpp"
#include "tool/monitor/map_view.hpp"
#include "tool/monitor/monitor_state.hpp"

namespace cornerd::tool {

/// The screen: title, map and panel (one above the other if narrow), advice and keys. Any size
/// works; 80 x 24 shows everything.
Frame draw_screen(const MonitorState& state, const Scene& scene, const ViewChoice& choice,
                  std::size_t columns, std::size_t rows, core::TimeNs now_ns);

}  // namespace cornerd::tool
