// SPDX-License-Identifier: MIT
#include "tool/monitor/screen.hpp"

#include <algorithm>
#include <cmath>

#include "tool/drawing/text_table.hpp"
#include "tool/monitor/advice.hpp"
#include "tool/monitor/pose_panel.hpp"

namespace cornerd::tool {

namespace {

constexpr std::size_t kPanelColumns = 32;
/// On a narrower screen the panel is above the map.
constexpr std::size_t kColumnsForBoth = 64;
/// Its rows then: state, pose and quality.
constexpr std::size_t kPanelRowsAbove = 6;
constexpr std::size_t kMinMapRows = 4;
constexpr std::size_t kRowsForAdvice = 20;
constexpr std::size_t kAdviceRows = 3;
constexpr std::size_t kMaxAdviceRows = 5;

void draw_title(Frame& frame, const MonitorState& state, const Scene& scene, core::TimeNs now_ns) {
  for (std::size_t column = 0; column < frame.columns(); ++column) {
    frame.put(column, 0, {U' ', Style::kTitle});
  }
  std::string title = "cornerd " + state.version();
  title += scene.map == nullptr ? "  no map" : "  " + scene.map->plan().name;
  const std::size_t end = frame.write(1, 0, title, Style::kTitle);
  // Shows the state even if there is no room for the panel.
  const std::string now = state_line(state, now_ns).text;
  if (end + 2 + now.size() + 1 <= frame.columns()) {
    frame.write(frame.columns() - now.size() - 1, 0, now, Style::kTitle);
  }
}

std::size_t draw_panel(Frame& frame, const Region& region, const MonitorState& state,
                       core::TimeNs now_ns) {
  const std::vector<PanelLine> lines = panel_lines(state, now_ns);
  const std::size_t count = std::min(lines.size(), region.rows);
  for (std::size_t i = 0; i < count; ++i) {
    frame.write(region.column, region.row + i, lines[i].text, lines[i].style,
                region.column + region.columns);
  }
  return count;
}

/// Returns the width of a cell of the map in metres.
double draw_body(Frame& frame, const Region& body, const MonitorState& state, const Scene& scene,
                 const ViewChoice& choice, core::TimeNs now_ns) {
  if (body.columns >= kColumnsForBoth) {
    const std::size_t map_columns = body.columns - kPanelColumns - 1;
    const Region panel{body.column + map_columns + 1, body.row, kPanelColumns, body.rows};
    draw_panel(frame, panel, state, now_ns);
    return draw_map(frame, {body.column, body.row, map_columns, body.rows}, state, scene, choice,
                    now_ns);
  }
  const std::size_t panel_rows =
      body.rows >= kPanelRowsAbove + kMinMapRows ? kPanelRowsAbove : body.rows;
  draw_panel(frame, {body.column, body.row, body.columns, panel_rows}, state, now_ns);
  return draw_map(frame, {body.column, body.row + panel_rows, body.columns, body.rows - panel_rows},
                  state, scene, choice, now_ns);
}

std::vector<PanelLine> advice_lines(const Advice& advice, std::size_t columns) {
  std::vector<PanelLine> lines;
  for (const std::string& line : wrap_text(advice.what, columns)) {
    lines.push_back({line, advice.style});
  }
  for (const std::string& line : wrap_text(advice.mend, columns)) lines.push_back({line});
  return lines;
}

/// Constant on a large screen unless the advice is long, so that the map does not move.
std::size_t advice_rows(std::size_t needed, std::size_t rows) {
  if (rows >= kRowsForAdvice) return std::clamp(needed, kAdviceRows, kMaxAdviceRows);
  return rows >= 3 ? 1 : 0;
}

/// "|-----| 0.5 m": the longest round length that fits.
std::string ruler_text(double metres_per_cell) {
  constexpr double kMaxLength_cells = 14;
  if (!(metres_per_cell > 0)) return "";
  const double longest_m = kMaxLength_cells * metres_per_cell;
  const double power = std::pow(10, std::floor(std::log10(longest_m)));
  double length_m = power;
  for (const double factor : {2.0, 5.0}) {
    if (factor * power <= longest_m) length_m = factor * power;
  }
  const double cells = std::max(2.0, std::round(length_m / metres_per_cell));
  return '|' + std::string(static_cast<std::size_t>(cells) - 2, '-') + "| " +
         formatted("%g m", length_m);
}

void draw_keys(Frame& frame, std::size_t row, double metres_per_cell) {
  const std::size_t end =
      frame.write(0, row, "q quit  + - zoom  l lidar's view  a ASCII", Style::kDim);
  const std::string ruler = ruler_text(metres_per_cell);
  if (end + 1 + ruler.size() <= frame.columns()) {
    frame.write(frame.columns() - ruler.size(), row, ruler, Style::kDim);
  }
}

}  // namespace

Frame draw_screen(const MonitorState& state, const Scene& scene, const ViewChoice& choice,
                  std::size_t columns, std::size_t rows, core::TimeNs now_ns) {
  Frame frame(columns, rows);
  const std::size_t all = frame.rows();
  const std::size_t key_rows = all >= 8 ? 1 : 0;
  const std::vector<PanelLine> advice = advice_lines(advise(state, now_ns), frame.columns());
  const std::size_t shown_rows = advice_rows(advice.size(), all);
  const std::size_t body_rows = all - std::min(all, 1 + key_rows + shown_rows);
  const double metres_per_cell =
      draw_body(frame, {0, 1, frame.columns(), body_rows}, state, scene, choice, now_ns);
  // A small screen may cut the end; the fault is in the first line.
  for (std::size_t i = 0; i < std::min(shown_rows, advice.size()); ++i) {
    frame.write(0, 1 + body_rows + i, advice[i].text, advice[i].style);
  }
  if (key_rows > 0) draw_keys(frame, all - 1, metres_per_cell);
  draw_title(frame, state, scene, now_ns);
  return frame;
}

}  // namespace cornerd::tool
