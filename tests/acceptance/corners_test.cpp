// SPDX-License-Identifier: MIT
// The figures of src/core/breakpoint/README.md, at 2,000 poses.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "bench/corner_experiment.hpp"
#include "settings/map_file.hpp"

namespace cornerd {
namespace {

constexpr std::size_t kSamples = 800;
constexpr std::size_t kPositions = 2000;

std::vector<std::shared_ptr<const core::WallMap>> layouts() {
  std::vector<std::shared_ptr<const core::WallMap>> maps;
  for (const std::string layout : {"a", "b", "c", "d"}) {
    maps.push_back(settings::load_map(std::filesystem::path(CORNERD_SOURCE_DIR) /
                                      ("config/maps/krpai-2019-" + layout + ".json")));
  }
  return maps;
}

double quantile(std::vector<double> values, double share) {
  std::sort(values.begin(), values.end());
  return values.at(static_cast<std::size_t>(share * static_cast<double>(values.size() - 1)));
}

TEST(Corners, EachNoiseLevel_PrecisionAndRecallHold) {
  const auto maps = layouts();
  for (const bench::Conditions& conditions : bench::default_conditions()) {
    SCOPED_TRACE(conditions.title);
    const bool noisy = conditions.sensor.noise.share > 0.007;
    const auto scores = bench::score_methods(maps, bench::paper_methods(), conditions.sensor,
                                             kSamples, kPositions, 11);
    const bench::CornerScore& altbd = scores.at(0).score;
    EXPECT_GE(altbd.precision(), noisy ? 0.985 : 0.993);
    EXPECT_GE(altbd.precision_of_corners(/*strictly=*/true), noisy ? 0.985 : 0.993);
    EXPECT_GE(altbd.recall_of_supported(), noisy ? 0.96 : 0.98);
    EXPECT_GE(altbd.recall_of_visible(), noisy ? 0.92 : 0.935);
    EXPECT_LE(quantile(altbd.errors_m(), 0.5), noisy ? 0.003 : 0.0015);
    EXPECT_LE(quantile(altbd.errors_m(), 0.95), noisy ? 0.020 : 0.012);
    for (const std::size_t baseline : {1U, 2U}) {
      EXPECT_GT(altbd.precision(), scores.at(baseline).score.precision());
      EXPECT_GT(altbd.recall_of_supported(), scores.at(baseline).score.recall_of_supported());
    }
  }
}

}  // namespace
}  // namespace cornerd
