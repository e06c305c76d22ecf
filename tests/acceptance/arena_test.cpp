// SPDX-License-Identifier: MIT
// The accuracy that the README states, from bytes to poses: a simulated A1 at random places of the
// four layouts of the contest arena, each turn localized without a prior.
#include <gtest/gtest.h>

#include <filesystem>
#include <memory>
#include <string>
#include <tuple>

#include "core/pipeline.hpp"
#include "replay/simulator/places.hpp"
#include "replay/simulator/simulated_recording.hpp"
#include "settings/map_file.hpp"
#include "tool/error_statistics.hpp"
#include "tool/playback.hpp"
#include "tool/truth.hpp"

namespace cornerd {
namespace {

using core::PoseState;
using rplidar::WireFormat;

struct Circumstances {
  WireFormat wire = WireFormat::kExpress;
  double missing_share = 0.005;
  double byte_fault_share = 0;
};

class Arena : public testing::TestWithParam<std::tuple<const char*, WireFormat>> {
 protected:
  static constexpr std::size_t kPlaces = 200;

  tool::ErrorStatistics localize(const Circumstances& circumstances) {
    const std::string layout = std::get<0>(GetParam());
    const auto map = settings::load_map(std::filesystem::path(CORNERD_SOURCE_DIR) /
                                        ("config/maps/krpai-2019-" + layout + ".json"));
    replay::SimulatedRecordingConfig config;
    config.simulator.wire = circumstances.wire;
    config.simulator.sensor.missing = circumstances.missing_share;
    config.simulator.seed = 20191;
    config.turns = kPlaces;
    config.byte_fault_share = circumstances.byte_fault_share;
    const std::string name = testing::TempDir() + "arena-" + layout +
                             std::to_string(static_cast<int>(circumstances.wire));
    const std::string recording_file = name + ".ndjson";
    const std::string truth_file = name + ".truth.ndjson";
    {
      replay::RecordingWriter recording(recording_file);
      replay::TruthWriter truth(truth_file);
      const auto places = replay::random_places(*map, kPlaces, 0.2, 20192);
      replay::simulate_recording(map, replay::visit_places(places, 1), config, recording, &truth);
    }
    const tool::Truth truth = tool::Truth::load(truth_file);
    tool::ErrorStatistics statistics;
    core::Pipeline pipeline(map, {});
    tool::Playback playback(pipeline, [&](const core::Scan&, const core::TurnResult& result) {
      const auto T_map_base = truth.at(result.pose.t_ns);
      if (T_map_base) statistics.add(result.pose, *T_map_base);
    });
    playback.set_independent(true);
    playback.play(recording_file, {});
    std::filesystem::remove(recording_file);
    std::filesystem::remove(truth_file);
    return statistics;
  }

  static double share(const tool::ErrorStatistics& statistics, PoseState state) {
    return static_cast<double>(statistics.count(state)) / static_cast<double>(statistics.turns());
  }
};

TEST_P(Arena, ClearTurns_AreFixedToTheMillimetre) {
  const auto statistics = localize({.wire = std::get<1>(GetParam())});
  SCOPED_TRACE(statistics.report());
  EXPECT_GE(statistics.turns(), kPlaces - 1);
  EXPECT_GE(share(statistics, PoseState::kFix), 0.99);
  EXPECT_EQ(statistics.wrong(), 0U);
  EXPECT_LT(statistics.mean_error_m(), 0.0005);
  EXPECT_GT(statistics.mean_nees(), 2.3);
  EXPECT_LT(statistics.mean_nees(), 4.2);
}

TEST_P(Arena, SixtyPercentMissing_AreStillFixed) {
  const auto statistics = localize({.wire = std::get<1>(GetParam()), .missing_share = 0.6});
  SCOPED_TRACE(statistics.report());
  EXPECT_GE(share(statistics, PoseState::kFix), 0.97);
  EXPECT_EQ(statistics.wrong(), 0U);
  EXPECT_LT(statistics.mean_error_m(), 0.001);
}

TEST_P(Arena, OneByteInTenThousandBad_CostsNoWrongPose) {
  const auto statistics = localize({.wire = std::get<1>(GetParam()), .byte_fault_share = 1e-4});
  SCOPED_TRACE(statistics.report());
  EXPECT_GE(statistics.turns(), kPlaces * 95 / 100);
  EXPECT_GE(share(statistics, PoseState::kFix), 0.95);
  EXPECT_EQ(statistics.wrong(), 0U);
}

INSTANTIATE_TEST_SUITE_P(Layouts, Arena,
                         testing::Combine(testing::Values("a", "b", "c", "d"),
                                          testing::Values(WireFormat::kStandard,
                                                          WireFormat::kExpress)));

}  // namespace
}  // namespace cornerd
