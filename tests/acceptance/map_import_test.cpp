// SPDX-License-Identifier: MIT
// The figures of src/gridmap/README.md: imported images of known buildings, the accuracy of their
// walls and of poses in them.
#include <gtest/gtest.h>

#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <tuple>

#include "../unit/gridmap/drawn_map.hpp"
#include "gridmap/grid_import.hpp"
#include "random_places.hpp"
#include "settings/map_file.hpp"

namespace cornerd {
namespace {

enum class Artist { kDrawing, kLidar };
using PictureKind = std::tuple<const char*, Artist, double, double>;

constexpr std::size_t kPlaces = 100;

tool::ErrorStatistics localize(const std::shared_ptr<const core::WallMap>& truth_map,
                               const std::shared_ptr<const core::WallMap>& map) {
  replay::SimulatedRecordingConfig config;
  config.simulator.seed = 20195;
  config.scans = kPlaces;
  return localize_random_places(truth_map, map, config);
}

std::shared_ptr<const core::WallMap> load(const std::string& name) {
  return settings::load_map(std::filesystem::path(CORNERD_SOURCE_DIR) / "config/maps" /
                            (name + ".json"));
}

class MapImportFigures : public testing::TestWithParam<PictureKind> {};

TEST_P(MapImportFigures, ImportedImage_WallsAndPosesAreAccurate) {
  const auto [name, maker, resolution_m, yaw_rad] = GetParam();
  const auto truth = load(name);
  const std::size_t scans = truth->corners().size() > 50 ? 300 : 100;
  const gridmap::DrawnMap drawn =
      maker == Artist::kDrawing ? gridmap::draw_map(*truth, resolution_m, yaw_rad)
                                : gridmap::scan_map(*truth, resolution_m, yaw_rad, 0.01, scans);
  gridmap::ImportResult result =
      gridmap::import_grid(drawn.grid, resolution_m, drawn.T_map_picture, {});
  const auto imported = std::make_shared<const core::WallMap>(std::move(result.plan));
  const gridmap::ImportScore score = gridmap::score_import(*truth, *imported, drawn);
  const tool::ErrorStatistics poses = localize(truth, imported);
  const std::size_t fixes = poses.count(core::PoseState::kFix);
  std::printf("%-12s %s %.2f m %.1f rad: %s; %zu of %zu fixes, mean %.1f mm, %zu wrong\n", name,
              maker == Artist::kDrawing ? "drawn" : "lidar", resolution_m, yaw_rad,
              score.text().c_str(), fixes, poses.scans(), 1000 * poses.mean_error_m(),
              poses.wrong());
  EXPECT_LT(score.missed_m, 0.02 * score.faces_m);
  EXPECT_LT(score.invented_m, 0.02 * score.faces_m);
  EXPECT_LT(score.median_m(), 0.5 * resolution_m + 0.009);  // of the arena's walls, half
  EXPECT_LE(poses.wrong(), poses.scans() / 50);
}

INSTANTIATE_TEST_SUITE_P(Pictures, MapImportFigures,
                         testing::Combine(testing::Values("flat-7", "krpai-2019-a"),
                                          testing::Values(Artist::kDrawing, Artist::kLidar),
                                          testing::Values(0.05, 0.02, 0.01),
                                          testing::Values(0.0, 0.2)));

/// Maps of a mapper whose poses are off by N(0, 3 cm), as its drift leaves them.
TEST(DriftedMapImportFigures, ImportedImage_PosesAreFound) {
  const auto truth = load("flat-7");
  for (const double resolution_m : {0.05, 0.03, 0.02}) {
    const gridmap::DrawnMap drawn =
        gridmap::scan_map(*truth, resolution_m, 0.2, 0.01, 300, /*drift_m=*/0.03);
    gridmap::ImportResult result =
        gridmap::import_grid(drawn.grid, resolution_m, drawn.T_map_picture, {});
    const auto imported = std::make_shared<const core::WallMap>(std::move(result.plan));
    const gridmap::ImportScore score = gridmap::score_import(*truth, *imported, drawn);
    const tool::ErrorStatistics poses = localize(truth, imported);
    const std::size_t fixes = poses.count(core::PoseState::kFix);
    std::printf("drifted %.2f m: %zu walls, sigma %.3f m, %s; %zu of %zu fixes, mean %.1f mm\n",
                resolution_m, imported->plan().walls.size(), imported->plan().sigma_m,
                score.text().c_str(), fixes, poses.scans(), 1000 * poses.mean_error_m());
    EXPECT_GE(fixes, poses.scans() * 9 / 10);
    EXPECT_LE(poses.wrong(), poses.scans() / 50);
    EXPECT_LE(imported->plan().walls.size(), 3 * truth->plan().walls.size());
  }
}

}  // namespace
}  // namespace cornerd
