// SPDX-License-Identifier: MIT
// Any bytes are a drawing or a PlanError; its lines give walls.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "plan/dxf_reader.hpp"
#include "plan/wall_pairing.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace cornerd::plan;
  constexpr std::size_t kMaxPairedLines = 300;
  try {
    const std::string_view text(reinterpret_cast<const char*>(data), size);
    Drawing drawing = read_dxf(text, {});
    drawing.lines.resize(std::min(drawing.lines.size(), kMaxPairedLines));
    static_cast<void>(pair_walls(drawing.lines, {}));
  } catch (const PlanError&) {
    return 0;
  }
  return 0;
}
