// SPDX-License-Identifier: MIT
#include "soak_run.hpp"

#include <malloc.h>
#include <poll.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <utility>

#include "core/geometry/angle.hpp"
#include "core/pipeline.hpp"
#include "daemon/localization.hpp"
#include "drivers/rplidar/rplidar_driver.hpp"
#include "message/line_writer.hpp"
#include "progress_monitor.hpp"
#include "replay/pose_error.hpp"
#include "replay/simulator/motion.hpp"
#include "replay/simulator/simulator.hpp"
#include "settings/map_file.hpp"
#include "tests/sanitized.hpp"

namespace cornerd::soak {
namespace {

using std::chrono::duration;
using Clock = std::chrono::steady_clock;

constexpr std::uint64_t kMaxGrowthBytes = 1 << 17;

/// Of all arenas. Not the resident memory: that of an emulated processor is its emulator's as well,
/// which grows with the code that has run once.
std::uint64_t heap_bytes() {
  const auto heap = ::mallinfo2();
  return heap.uordblks + heap.hblkhd;
}

/// Map, trajectory, emulated device and faults.
class World {
 public:
  explicit World(const SoakConfig& config)
      : map(settings::load_map(std::filesystem::path(CORNERD_SOURCE_DIR) /
                               "config/maps/krpai-2019-a.json")),
        motion(replay::drive_path({{0.36, 1.1},
                                   {0.36, 0.24},
                                   {0.95, 0.24},
                                   {0.95, 1.15},
                                   {1.6, 1.15},
                                   {0.95, 1.15},
                                   {0.95, 0.24},
                                   {0.36, 0.24}},
                                  {.speed_m_s = 0.2,
                                   .yaw_rate_rad_s = 1,
                                   .acceleration_m_s2 = 0.5,
                                   .yaw_acceleration_rad_s2 = 4,
                                   .loop = true})),
        device(emulator(config.seed), clock, config.seed + 1),
        plan(device, *scene, config.faults, config.seed + 2) {
    clock.set_on_advance([this](core::TimeNs now_ns) { plan.advance(now_ns); });
  }

  std::shared_ptr<const core::WallMap> map;
  replay::Motion motion;
  replay::CoverableScene* scene = nullptr;
  replay::VirtualClock clock;
  replay::EmulatedDevice device;
  FaultPlan plan;

 private:
  replay::Emulator emulator(std::uint64_t seed) {
    auto coverable =
        std::make_unique<replay::CoverableScene>(std::make_unique<replay::MapScene>(map, motion));
    scene = coverable.get();
    replay::SimulatorConfig simulator;
    simulator.seed = seed;
    return {{}, std::make_unique<replay::Simulator>(std::move(coverable), simulator)};
  }
};

std::string describe(const core::PoseEstimate& pose, const core::Pose2& truth, std::uint64_t scan,
                     const FaultPlan& plan) {
  const auto degrees = [](double angle_rad) { return core::degrees(angle_rad); };
  char text[256];
  std::snprintf(text, sizeof(text),
                "scan %llu, %.3f s: %s at %.3f %.3f %.1f, truth %.3f %.3f %.1f; %d corners, "
                "%d inliers, rmse %.4f m; ",
                static_cast<unsigned long long>(scan), core::to_seconds(pose.t_ns),
                message::to_string(pose.state).data(), pose.T_map_base.x_m, pose.T_map_base.y_m,
                degrees(pose.T_map_base.theta_rad), truth.x_m, truth.y_m, degrees(truth.theta_rad),
                static_cast<int>(pose.corners), static_cast<int>(pose.inliers), pose.rmse_m);
  return text + plan.at(pose.t_ns);
}

/// True if there is a pose and it is wrong. Updates the worst errors.
bool is_wrong(const core::PoseEstimate& pose, const core::Pose2& truth, SoakReport& report) {
  if (!core::has_pose(pose.state)) return false;
  const replay::PoseError error = replay::error_of(pose.T_map_base, truth);
  report.worst_error_m = std::max(report.worst_error_m, error.position_m);
  report.worst_error_rad = std::max(report.worst_error_rad, error.heading_rad);
  return !replay::is_right(pose.T_map_base, truth);
}

}  // namespace

SoakReport run(const SoakConfig& config) {
  World world(config);
  rplidar::RplidarDriver driver(
      {.device = "/dev/emulated", .motor = {}},
      [&world](std::uint32_t /*baud*/) { return world.device.open(); }, world.clock);
  SoakReport report;
  const auto began = Clock::now();
  {
    // kRecording: the source waits for the localizer, as virtual time allows.
    daemon::Localization localization(
        driver, std::make_unique<core::Pipeline>(world.map, core::LocalizerConfig{}),
        daemon::SourceKind::kRecording);
    localization.start();
    ProgressMonitor watch(Activity::now());
    pollfd readable{localization.event_fd(), POLLIN, 0};
    while (report.scans < config.scans) {
      ::poll(&readable, 1, 100);
      const auto judge = [&](const daemon::ScanReport& scan) {
        ++report.scans;
        ++report.poses[static_cast<std::size_t>(scan.result.pose.state)];
        const core::PoseEstimate& pose = scan.result.pose;
        const core::Pose2 truth = world.motion(pose.t_ns, 0);
        if (!is_wrong(pose, truth, report)) return;
        ++report.wrong;
        if (config.on_wrong) {
          config.on_wrong(describe(pose, truth, report.scans, world.plan));
        }
      };
      localization.take(judge, [](const core::PoseEstimate&) {});
      if (report.warm_bytes == 0 && report.scans >= config.scans / 10) {
        report.warm_bytes = heap_bytes();
      }
      watch.update(Activity::now(), localization.has_progressed());
      if (watch.stalled_s() > 2 * config.max_stall_s) break;
    }
    report.max_without_progress_s = watch.max_stalled_s();
    report.end_bytes = heap_bytes();
  }
  report.real_s = duration<double>(Clock::now() - began).count();
  report.simulated_s = core::to_seconds(world.clock.monotonic_ns());
  report.faults = world.plan.counts();
  report.counters = driver.status().counters;
  report.read_bytes = world.device.read_bytes();
  return report;
}

std::vector<std::string> SoakReport::failures(const SoakConfig& config) const {
  std::vector<std::string> failures;
  const auto require = [&failures](bool holds, const char* what) {
    if (!holds) failures.emplace_back(what);
  };
  require(scans >= config.scans, "scans are missing: the loops stopped");
  require(wrong == 0, "there were wrong poses");
  require(counters.bytes == read_bytes, "received bytes are not counted");
  require(counters.used_bytes + counters.skipped_bytes == counters.bytes,
          "bytes are neither used nor skipped");
  require(max_without_progress_s < config.max_stall_s, "a watchdog would have expired");
  require(test::kSanitized || end_bytes < warm_bytes + kMaxGrowthBytes, "memory grew");
  return failures;
}

}  // namespace cornerd::soak
