// SPDX-License-Identifier: MIT
// Walls measured by tape are off by a centimetre. Poses in such a map need a covariance that
// contains this.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <random>
#include <string>
#include <utility>

#include "random_places.hpp"
#include "replay/simulator/map_error.hpp"
#include "settings/map_file.hpp"

namespace cornerd {
namespace {

/// The building with each wall line displaced from the map by this standard deviation.
core::FloorPlan moved(core::FloorPlan plan, double sigma_m, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> off_m(0, sigma_m);
  std::map<std::pair<int, long>, double> lines;  // key: axis and position in millimetres
  const auto off_of = [&](int axis, double at_m) {
    const auto [line, is_new] = lines.try_emplace({axis, std::lround(1000 * at_m)}, 0);
    if (is_new) line->second = off_m(random);
    return line->second;
  };
  for (core::Wall& wall : plan.walls) {
    for (core::Vec2* end : {&wall.from, &wall.to}) {
      *end += core::Vec2(off_of(0, end->x()), off_of(1, end->y()));
    }
  }
  plan.rooms.clear();
  return plan;
}

/// Ten scans at each.
auto localize_ten_places(const std::shared_ptr<const core::WallMap>& building,
                         const std::shared_ptr<const core::WallMap>& map, std::uint64_t seed) {
  replay::SimulatedRecordingConfig config;
  config.simulator.seed = seed;
  config.scans = 100;
  return localize_random_places(building, map, config, /*scans_each=*/10);
}

TEST(InexactMap, DisplacedWalls_CovarianceIsConsistent) {
  const auto map =
      settings::load_map(std::filesystem::path(CORNERD_SOURCE_DIR) / "config/maps/flat-7.json");
  // Few lines fix a flat's frame: NEES is 1 to 12 from building to building.
  constexpr int kBuildings = 30;
  for (const double sigma_m : {0.001, 0.003, 0.01}) {
    double nees = 0;
    double error_m = 0;
    for (std::uint64_t seed = 1; seed <= kBuildings; ++seed) {
      const auto building =
          std::make_shared<const core::WallMap>(moved(map->plan(), sigma_m, seed));
      const auto statistics = localize_ten_places(building, map, seed);
      SCOPED_TRACE(statistics.report());
      EXPECT_EQ(statistics.wrong(), 0U);
      EXPECT_GE(statistics.count(core::PoseState::kFix), 83U);
      nees += statistics.mean_nees() / kBuildings;
      error_m += statistics.mean_error_m() / kBuildings;
    }
    EXPECT_GT(error_m, sigma_m / 3);
    EXPECT_LT(nees, 6) << sigma_m;  // 20 to 500 with the point noise alone
    EXPECT_GT(nees, 2) << sigma_m;
    RecordProperty("nees_" + std::to_string(std::lround(1000 * sigma_m)) + "_mm",
                   std::to_string(nees));
  }
}

TEST(InexactMap, EndsOfWallsOffByACentimetre_CovarianceIsConsistent) {
  for (const char* name : {"flat-7", "krpai-2019-a"}) {
    const auto map = settings::load_map(std::filesystem::path(CORNERD_SOURCE_DIR) / "config/maps" /
                                        (std::string(name) + ".json"));
    constexpr int kBuildings = 30;
    double nees = 0;
    for (std::uint64_t seed = 1; seed <= kBuildings; ++seed) {
      const auto building =
          std::make_shared<const core::WallMap>(replay::with_end_error(map->plan(), 0.01, seed));
      const auto statistics = localize_ten_places(building, map, seed);
      SCOPED_TRACE(statistics.report());
      EXPECT_EQ(statistics.wrong(), 0U);
      nees += statistics.mean_nees() / kBuildings;
    }
    EXPECT_LT(nees, 5) << name;
    EXPECT_GT(nees, 1) << name;
  }
}

}  // namespace
}  // namespace cornerd
