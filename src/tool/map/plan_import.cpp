// SPDX-License-Identifier: MIT
#include "tool/map/plan_import.hpp"

#include <algorithm>
#include <cctype>
#include <vector>

#include "plan/dxf_reader.hpp"
#include "plan/svg_reader.hpp"
#include "settings/document.hpp"
#include "settings/map_file.hpp"
#include "tool/command_line/failure.hpp"
#include "tool/drawing/text_table.hpp"

namespace cornerd::tool {

namespace {

using core::Vec2;

constexpr std::size_t kMaxPlanBytes = 64 << 20;
/// Names in a line of the report.
constexpr std::size_t kMaxNames = 12;

std::string suffix_of(const std::filesystem::path& file) {
  std::string suffix = file.extension().string();
  std::transform(suffix.begin(), suffix.end(), suffix.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return suffix;
}

/// "walls 12, doors 3"; control characters of names do not reach the terminal.
std::string counts_text(const std::map<std::string, std::size_t>& counts) {
  std::string text;
  std::size_t shown = 0;
  for (const auto& [name, count] : counts) {
    if (++shown > kMaxNames) return text + ", ...";
    text += (text.empty() ? "" : ", ") + settings::one_line(name) + " " + std::to_string(count);
  }
  return text;
}

double scale_of(const plan::Drawing& drawing, const PlanImportOptions& options) {
  if (options.metres_per_unit > 0) return options.metres_per_unit;
  if (drawing.metres_per_unit) return *drawing.metres_per_unit;
  throw plan::PlanError(
      "does not state its unit: give --scale METRES_PER_UNIT (0.001 where it is drawn in "
      "millimetres)");
}

/// In metres. Drawings of a site may be far from the origin of a country: those are moved there.
std::vector<plan::DrawnLine> to_metres(const plan::Drawing& drawing, double scale_m,
                                       std::string& report) {
  std::vector<plan::DrawnLine> lines;
  Vec2 low = Vec2::Constant(1e300);
  Vec2 high = -low;
  for (const plan::DrawnLine& line : drawing.lines) {
    lines.push_back({scale_m * line.from, scale_m * line.to});
    low = low.cwiseMin(lines.back().from).cwiseMin(lines.back().to);
    high = high.cwiseMax(lines.back().from).cwiseMax(lines.back().to);
  }
  if (std::max(-low.minCoeff(), high.maxCoeff()) <= settings::kMaxCoordinateM) return lines;
  if ((high - low).maxCoeff() > settings::kMaxCoordinateM) {
    throw plan::PlanError(formatted(
        "is %.0f x %.0f m large at %g m per unit: give another --scale, or the walls' --layer",
        high.x() - low.x(), high.y() - low.y(), scale_m));
  }
  for (plan::DrawnLine& line : lines) {
    line.from -= low;
    line.to -= low;
  }
  report += formatted("%-12s by (%.3f, %.3f) m, to the origin\n", "moved", -low.x(), -low.y());
  return lines;
}

PlanImport import_text(const std::string& text, bool is_svg, const PlanImportOptions& options) {
  const plan::Drawing drawing =
      is_svg ? plan::read_svg(text, options.layers) : plan::read_dxf(text, options.layers);
  if (drawing.lines.empty()) {
    const std::string ignored = counts_text(drawing.ignored);
    throw plan::PlanError("has no lines" + (ignored.empty() ? "" : "; ignored: " + ignored));
  }
  const double scale_m = scale_of(drawing, options);
  PlanImport imported;
  imported.report = formatted("%-12s %zu lines, %g m per unit%s\n", "drawing", drawing.lines.size(),
                              scale_m, options.metres_per_unit > 0 ? "" : " as it states");
  if (!drawing.layers.empty()) {
    imported.report += formatted("%-12s %s\n", "layers", counts_text(drawing.layers).c_str());
  }
  if (!drawing.ignored.empty()) {
    imported.report += formatted("%-12s %s\n", "ignored", counts_text(drawing.ignored).c_str());
  }
  const auto lines = to_metres(drawing, scale_m, imported.report);
  plan::PairedWalls paired = plan::pair_walls(lines, options.pairing);
  if (paired.walls.empty()) {
    throw plan::PlanError(
        formatted("has no line of a millimetre at %g m per unit: give another --scale", scale_m));
  }
  imported.report += formatted("%-12s %zu of two lines, %zu of one\n", "walls", paired.two_sided,
                               paired.walls.size() - paired.two_sided);
  imported.plan.walls = std::move(paired.walls);
  return imported;
}

}  // namespace

bool is_drawn_plan(const std::filesystem::path& file) {
  const std::string suffix = suffix_of(file);
  return suffix == ".svg" || suffix == ".dxf";
}

PlanImport import_plan_file(const std::filesystem::path& file, const PlanImportOptions& options) {
  const std::string text = settings::read_file(file, kMaxPlanBytes);
  try {
    return import_text(text, suffix_of(file) == ".svg", options);
  } catch (const plan::PlanError& error) {
    throw settings::SettingsError(file.string(), "", error.what());
  }
}

}  // namespace cornerd::tool
