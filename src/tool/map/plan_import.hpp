// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>

#include "core/map/wall_map.hpp"
#include "plan/drawing.hpp"
#include "plan/wall_pairing.hpp"

namespace cornerd::tool {

struct PlanImportOptions {
  double metres_per_unit = 0;  ///< 0: what the drawing states
  plan::LayerChoice layers;    ///< empty: all
  plan::PairingOptions pairing;
};

struct PlanImport {
  core::FloorPlan plan;
  std::string report;  ///< lines of what was read
};

/// By the file's name: *.svg, *.dxf.
bool is_drawn_plan(const std::filesystem::path& file);

/// Throws settings::SettingsError, with the file, or Failure.
PlanImport import_plan_file(const std::filesystem::path& file, const PlanImportOptions& options);

}  // namespace cornerd::tool
