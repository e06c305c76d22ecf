// SPDX-License-Identifier: MIT
#include "bench/localization/cost.hpp"

#include "bench/localization/world.hpp"
#include "core/localizer.hpp"
#include "replay/simulator/scan_simulator.hpp"

namespace cornerd::bench {
namespace {

constexpr std::size_t kCostSamples = 800;
constexpr std::uint64_t kCostSeed = 1;

}  // namespace

void localize_scans(const std::shared_ptr<const core::WallMap>& map, std::size_t scans,
                    bool tracking) {
  const CircularMotion motion = tracking ? CircularMotion{0.2, 1.5} : CircularMotion{};
  const auto poses = random_circles(*map, motion, tracking ? 1 : kMaxCountedScans, kCostSeed);
  replay::ScanSimulator lidar({}, kCostSamples, kCostSeed);
  core::Localizer localizer(map, {});
  core::TimeNs t_ns = 0;
  for (std::size_t i = 0; i < kMaxCountedScans; ++i, t_ns += lidar.scan_ns()) {
    const core::Scan& scan = lidar.take(*map, t_ns, circling(poses[tracking ? 0 : i], motion));
    if (i >= scans) continue;
    if (!tracking) localizer.relocalize();
    localizer.step(scan);
  }
}

}  // namespace cornerd::bench
