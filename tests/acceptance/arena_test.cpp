// SPDX-License-Identifier: MIT
// The accuracy that the README states, from bytes to poses: a simulated A1 at random places of the
// contest arena's four layouts, each scan localized without a prior.
#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <tuple>

#include "random_places.hpp"
#include "settings/map_file.hpp"

namespace cornerd {
namespace {

using core::PoseState;
using rplidar::WireFormat;

struct Conditions {
  WireFormat wire = WireFormat::kExpress;
  double missing_share = 0.005;
  double byte_fault_share = 0;
};

class Arena : public testing::TestWithParam<std::tuple<const char*, WireFormat>> {
 protected:
  static constexpr std::size_t kPlaces = 200;

  tool::ErrorStatistics localize(const Conditions& conditions) {
    const std::string layout = std::get<0>(GetParam());
    const auto map = settings::load_map(std::filesystem::path(CORNERD_SOURCE_DIR) /
                                        ("config/maps/krpai-2019-" + layout + ".json"));
    replay::SimulatedRecordingConfig config;
    config.simulator.wire = conditions.wire;
    config.simulator.sensor.missing = conditions.missing_share;
    config.simulator.seed = 20191;
    config.scans = kPlaces;
    config.byte_fault_share = conditions.byte_fault_share;
    return localize_random_places(map, map, config);
  }

  static double share(const tool::ErrorStatistics& statistics, PoseState state) {
    return static_cast<double>(statistics.count(state)) / static_cast<double>(statistics.scans());
  }
};

TEST_P(Arena, CleanScans_ErrorBelowMillimetre) {
  const auto statistics = localize({.wire = std::get<1>(GetParam())});
  SCOPED_TRACE(statistics.report());
  EXPECT_GE(statistics.scans(), kPlaces - 1);
  EXPECT_GE(share(statistics, PoseState::kFix), 0.99);
  EXPECT_EQ(statistics.wrong(), 0U);
  EXPECT_LT(statistics.mean_error_m(), 0.0005);
  EXPECT_GT(statistics.mean_nees(), 2);  // of 3: in standard mode a covariance a fifth too wide
  EXPECT_LT(statistics.mean_nees(), 4.2);
}

TEST_P(Arena, SixtyPercentMissing_StateIsFix) {
  const auto statistics = localize({.wire = std::get<1>(GetParam()), .missing_share = 0.6});
  SCOPED_TRACE(statistics.report());
  EXPECT_GE(share(statistics, PoseState::kFix), 0.97);
  EXPECT_EQ(statistics.wrong(), 0U);
  EXPECT_LT(statistics.mean_error_m(), 0.001);
}

TEST_P(Arena, OneByteInTenThousandCorrupted_NoWrongPose) {
  const auto statistics = localize({.wire = std::get<1>(GetParam()), .byte_fault_share = 1e-4});
  SCOPED_TRACE(statistics.report());
  EXPECT_GE(statistics.scans(), kPlaces * 95 / 100);
  EXPECT_GE(share(statistics, PoseState::kFix), 0.95);
  EXPECT_EQ(statistics.wrong(), 0U);
}

INSTANTIATE_TEST_SUITE_P(Layouts, Arena,
                         testing::Combine(testing::Values("a", "b", "c", "d"),
                                          testing::Values(WireFormat::kStandard,
                                                          WireFormat::kExpress)));

}  // namespace
}  // namespace cornerd
