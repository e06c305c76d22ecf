// SPDX-License-Identifier: MIT
#include "random_places.hpp"

#include <utility>

#include "core/pipeline.hpp"
#include "replay/simulator/random_poses.hpp"
#include "tests/temporary_folder.hpp"
#include "tool/replay/playback.hpp"
#include "tool/replay/truth.hpp"

namespace cornerd {

tool::ErrorStatistics localize_random_places(std::shared_ptr<const core::WallMap> building,
                                             std::shared_ptr<const core::WallMap> map,
                                             const replay::SimulatedRecordingConfig& config,
                                             std::size_t scans_each) {
  const test::TemporaryFolder folder;
  const auto recording_file = folder / "recording.ndjson";
  const auto truth_file = folder / "truth.ndjson";
  {
    replay::RecordingWriter recording(recording_file);
    replay::TruthWriter truth(truth_file);
    const auto places =
        replay::random_poses(*building, config.scans / scans_each, 0.2, config.simulator.seed + 1);
    replay::simulate_recording(building, replay::visit_poses(places, static_cast<int>(scans_each)),
                               config, recording, &truth);
  }
  const tool::Truth truth = tool::Truth::load(truth_file);
  tool::ErrorStatistics statistics;
  core::Pipeline pipeline(std::move(map), {});
  tool::Playback playback(pipeline, [&](const core::Scan&, const core::ScanResult& result) {
    const auto T_map_base = truth.at(result.pose.t_ns);
    if (T_map_base) statistics.add(result.pose, *T_map_base);
  });
  playback.set_independent(scans_each == 1);
  playback.play(recording_file, {});
  return statistics;
}

}  // namespace cornerd
