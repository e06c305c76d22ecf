// SPDX-License-Identifier: MIT
#include "daemon/localization.hpp"

#include <gtest/gtest.h>
#include <poll.h>

#include <atomic>
#include <chrono>
#include <cmath>
#include <thread>
#include <vector>

#include "daemon/posix_clock.hpp"
#include "tests/wait_until.hpp"

namespace cornerd::daemon {
namespace {

/// Scans of a round room, as fast as the sink takes them. Then it waits to be stopped, as a device
/// does, or ends, as a recording does.
class FakeLidar final : public drivers::LidarDriver {
 public:
  FakeLidar(int scans, bool ends) : scans_(scans), ends_(ends) {}

  void run(std::stop_token stop, drivers::SampleSink& sink) override {
    constexpr int kSamples = 360;
    for (int scan = 0; scan < scans_ && !stop.stop_requested(); ++scan) {
      for (int i = 0; i < kSamples; ++i) {
        const double bearing_rad = core::kPi - core::kTwoPi * i / kSamples;
        sink.on_sample({.t_ns = std::int64_t{scan} * 1000 + i,
                        .bearing_rad = static_cast<float>(bearing_rad),
                        .range_m = 1,
                        .starts_scan = i == 0});
      }
    }
    while (!ends_ && !stop.stop_requested()) {
      if (!is_stuck_) count_progress();
      std::this_thread::yield();
    }
    stopped_ = true;
  }
  drivers::LidarStatus status() override { return {}; }
  bool take_change(drivers::LidarChange& /*change*/) override { return false; }

  void get_stuck() { is_stuck_ = true; }
  bool has_stopped() const { return stopped_; }

 private:
  const int scans_;
  const bool ends_;
  std::atomic<bool> stopped_{false};
  std::atomic<bool> is_stuck_{false};
};

std::unique_ptr<core::Pipeline> pipeline_without_map() {
  return std::make_unique<core::Pipeline>(nullptr, core::LocalizerConfig{});
}

/// Start times of `count` reported scans; fewer if no more arrive.
std::vector<core::TimeNs> collect(Localization& localization, std::size_t count) {
  std::vector<core::TimeNs> starts;
  pollfd readable{localization.event_fd(), POLLIN, 0};
  while (starts.size() < count && ::poll(&readable, 1, 30'000) == 1) {
    localization.take(
        [&starts](const ScanReport& report) {
          EXPECT_EQ(report.scan.size(), 360u);
          EXPECT_GT(report.latency_ns, 0);
          EXPECT_EQ(report.result.pose.state, core::PoseState::kLost) << "there is no map";
          starts.push_back(report.scan.start_ns());
        },
        [](const core::PoseEstimate&) { FAIL() << "no odometry"; });
  }
  return starts;
}

TEST(Localization, Recording_EveryScanReportedInOrder) {
  // As many as there are slots, so that none is lost if this thread is slow.
  constexpr std::size_t kScans = 16;
  FakeLidar lidar(kScans, /*ends=*/true);
  Localization localization(lidar, pipeline_without_map(), SourceKind::kRecording);
  localization.start();
  const auto starts = collect(localization, kScans);
  ASSERT_EQ(starts.size(), kScans) << "including the last scan";
  for (std::size_t i = 0; i < kScans; ++i)
    EXPECT_EQ(starts[i], static_cast<core::TimeNs>(i) * 1000);
  EXPECT_EQ(localization.lost_reports(), 0u);
}

TEST(Localization, BusyServer_NewScansLostAndCounted) {
  constexpr int kScans = 100;
  FakeLidar lidar(kScans, /*ends=*/true);
  Localization localization(lidar, pipeline_without_map(), SourceKind::kRecording);
  localization.start();
  ASSERT_TRUE(test::wait_until([&] { return localization.lost_reports() + 16 >= kScans; }));
  const auto starts = collect(localization, 16);
  EXPECT_EQ(starts.size(), 16u);
  EXPECT_EQ(starts.front(), 0);
}

TEST(Localization, Destructor_StopsWaitingDriver) {
  FakeLidar lidar(3, /*ends=*/false);
  {
    Localization localization(lidar, pipeline_without_map(), SourceKind::kDevice);
    localization.start();
    collect(localization, 2);
  }
  EXPECT_TRUE(lidar.has_stopped());
}

TEST(Localization, DestructorBeforeStart_DoesNothing) {
  FakeLidar lidar(1, /*ends=*/true);
  const Localization localization(lidar, pipeline_without_map(), SourceKind::kDevice);
  EXPECT_FALSE(lidar.has_stopped());
}

TEST(Localization, ReplacedPipeline_NoScanMissed) {
  FakeLidar lidar(16, /*ends=*/true);
  Localization localization(lidar, pipeline_without_map(), SourceKind::kRecording);
  EXPECT_EQ(localization.replace_pipeline(pipeline_without_map()), 1u);
  EXPECT_EQ(localization.replace_pipeline(pipeline_without_map()), 2u)
      << "replaces a pipeline that was never used";
  localization.start();
  std::vector<std::uint32_t> generations;
  std::vector<core::TimeNs> starts;
  pollfd readable{localization.event_fd(), POLLIN, 0};
  while (starts.size() < 16 && ::poll(&readable, 1, 30'000) == 1) {
    localization.take(
        [&](const ScanReport& report) {
          generations.push_back(report.generation);
          starts.push_back(report.scan.start_ns());
        },
        [](const core::PoseEstimate&) { FAIL() << "no odometry"; });
  }
  for (std::size_t i = 0; i < starts.size(); ++i) {
    EXPECT_EQ(starts[i], static_cast<core::TimeNs>(i) * 1000);
    EXPECT_EQ(generations[i], 2u);
  }
  EXPECT_EQ(starts.size(), 16u);
  localization.replace_pipeline(pipeline_without_map());
}

TEST(Localization, ReplacedPipeline_GoesOnWithTheOdometry) {
  FakeLidar lidar(4, /*ends=*/true);
  core::LocalizerConfig config;
  config.odometry.enabled = true;
  const auto pipeline = [&] { return std::make_unique<core::Pipeline>(nullptr, config); };
  Localization localization(lidar, pipeline(), SourceKind::kRecording);
  core::OdometryReading reading;
  reading.left = reading.right = 0;
  for (; reading.t_ns < 5; ++reading.t_ns) localization.add(reading);
  localization.replace_pipeline(pipeline());
  localization.start();
  pollfd readable{localization.event_fd(), POLLIN, 0};
  std::size_t scans = 0;
  while (scans < 4 && ::poll(&readable, 1, 30'000) == 1) {
    localization.take(
        [&](const ScanReport& report) {
          ++scans;
          EXPECT_EQ(report.result.odometry.counters.readings, 5u) << report.generation;
        },
        [](const core::PoseEstimate&) {});
  }
  EXPECT_EQ(scans, 4u);
}

TEST(Localization, InitialPose_IsReportedWithTheNextScanAlone) {
  FakeLidar lidar(4, /*ends=*/true);
  Localization localization(lidar, pipeline_without_map(), SourceKind::kRecording);
  localization.set_initial_pose({});
  localization.start();
  std::vector<bool> follows;
  pollfd readable{localization.event_fd(), POLLIN, 0};
  while (follows.size() < 4 && ::poll(&readable, 1, 30'000) == 1) {
    localization.take(
        [&](const ScanReport& report) { follows.push_back(report.follows_initial_pose); },
        [](const core::PoseEstimate&) {});
  }
  EXPECT_EQ(follows, (std::vector<bool>{true, false, false, false}));
}

TEST(Localization, IdleLocalizer_HasProgressed) {
  FakeLidar lidar(0, /*ends=*/false);
  Localization localization(lidar, pipeline_without_map(), SourceKind::kDevice);
  localization.start();
  for (int round = 0; round < 3; ++round) {
    EXPECT_TRUE(test::wait_until([&] { return localization.has_progressed(); }));
  }
}

TEST(Localization, StuckReader_NoProgress) {
  FakeLidar lidar(0, /*ends=*/false);
  lidar.get_stuck();
  Localization localization(lidar, pipeline_without_map(), SourceKind::kDevice);
  localization.start();
  const auto until = std::chrono::steady_clock::now() + std::chrono::milliseconds(100);
  while (std::chrono::steady_clock::now() < until) EXPECT_FALSE(localization.has_progressed());
}

TEST(Localization, ReaderAtEndOfRecording_HasProgressed) {
  FakeLidar lidar(0, /*ends=*/true);
  Localization localization(lidar, pipeline_without_map(), SourceKind::kRecording);
  localization.start();
  ASSERT_TRUE(test::wait_until([&] { return lidar.has_stopped(); }));
  for (int round = 0; round < 3; ++round) {
    EXPECT_TRUE(test::wait_until([&] { return localization.has_progressed(); }));
  }
}

TEST(Localization, Device_ScansReportedInUnixTime) {
  FakeLidar lidar(3, /*ends=*/false);
  Localization localization(lidar, pipeline_without_map(), SourceKind::kDevice);
  localization.start();
  const core::TimeNs offset_ns = unix_ns() - monotonic_ns();
  for (const core::TimeNs start_ns : collect(localization, 2)) {
    EXPECT_NEAR(static_cast<double>(start_ns - offset_ns), 0, 1e9);
  }
}

}  // namespace
}  // namespace cornerd::daemon
