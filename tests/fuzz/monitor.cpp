// SPDX-License-Identifier: MIT
// For any lines of a daemon and any screen size, every frame is complete and has no control
// characters. The first two bytes are the size; the rest are lines, keys and text.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "tool/doctor/machine.hpp"
#include "tool/doctor/process_table.hpp"
#include "tool/monitor/monitor_state.hpp"
#include "tool/monitor/screen.hpp"
#include "tool/monitor/terminal.hpp"

namespace {

using namespace cornerd;

const core::WallMap& small_map() {
  static const core::WallMap map([] {
    core::FloorPlan plan;
    plan.walls = {{{0, 0}, {2, 0}, 0.02}, {{2, 0}, {2, 1}, 0.02}, {{2, 1}, {0, 0}, 0}};
    return plan;
  }());
  return map;
}

void check_frame(const tool::Frame& frame) {
  for (std::size_t row = 0; row < frame.rows(); ++row) {
    for (std::size_t column = 0; column < frame.columns(); ++column) {
      const char32_t glyph = frame.at(column, row).glyph;
      if (glyph < 0x20 || (glyph >= 0x7f && glyph <= 0xa0)) std::abort();
    }
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size < 2) return 0;
  const std::size_t columns = data[0];
  const std::size_t rows = data[1] % 64;
  const std::string_view text(reinterpret_cast<const char*>(data) + 2, size - 2);

  tool::MonitorState state;
  core::TimeNs now_ns = 0;
  state.connect(now_ns);
  for (const std::string_view line : tool::split_words(text, "\n")) {
    state.take_line(line, now_ns += core::kNsPerSecond / 7);
  }
  tool::ViewChoice choice;
  choice.unicode = columns % 2 == 0;
  choice.zoom = static_cast<int>(columns % 3);
  const tool::Scene scene{rows % 2 == 0 ? &small_map() : nullptr, {}};
  check_frame(tool::draw_screen(state, scene, choice, columns, rows, now_ns));
  state.lose(text, now_ns);
  check_frame(tool::draw_screen(state, scene, choice, columns, rows, now_ns));

  if (tool::plain_keys(text).size() > text.size()) std::abort();
  tool::FileFacts file;
  file.inode = 345;
  if (const auto pid = tool::lock_owner(text, file); pid && *pid <= 0) std::abort();
  return 0;
}
