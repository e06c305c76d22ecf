// SPDX-License-Identifier: MIT
// The path from a sample to a pose allocates nothing after construction. Replaces the program's
// operator new, and so counts the allocations of the standard library and of Eigen (through
// malloc).
#include <gtest/gtest.h>

#include <atomic>
#include <cstdlib>
#include <new>

#include "baseline/wall_finders.hpp"
#include "core/breakpoint/breakpoint_stream.hpp"
#include "core/pipeline.hpp"
#include "fixtures.hpp"

namespace {

std::atomic<long> allocations{0};

void* allocate(std::size_t size) {
  ++allocations;
  void* memory =
      std::malloc(size == 0 ? 1 : size);  // NOLINT: operator new is implemented by malloc
  if (memory == nullptr) throw std::bad_alloc();
  return memory;
}

}  // namespace

void* operator new(std::size_t size) { return allocate(size); }
void* operator new[](std::size_t size) { return allocate(size); }
void* operator new(std::size_t size, const std::nothrow_t&) noexcept {
  ++allocations;
  return std::malloc(size == 0 ? 1 : size);  // NOLINT
}
void operator delete(void* memory) noexcept { std::free(memory); }                 // NOLINT
void operator delete[](void* memory) noexcept { std::free(memory); }               // NOLINT
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }    // NOLINT
void operator delete[](void* memory, std::size_t) noexcept { std::free(memory); }  // NOLINT

namespace cornerd::core {
namespace {

TEST(Pipeline, SampleToPose_AllocatesNothing) {
  const auto map = testing::make_map(testing::l_shaped_room());
  const auto symmetric = testing::make_map(testing::rectangular_room(3, 2));
  testing::ScanSource source(71);
  std::vector<Scan> scans;
  testing::ScanOptions sparse;
  sparse.missing_share = 0.8;
  scans.emplace_back();
  scans.back().add({0, 0, 1, 15, true, true});
  for (int k = 0; k < 20; ++k) {
    scans.push_back(source.take(*map, source.place_in(0.4, 2.2, 0.4, 1.4)));
    scans.push_back(source.take(*map, source.place_in(0.4, 2.2, 0.4, 1.4), sparse));
    scans.push_back(source.take(*symmetric, source.place_in(0.4, 2.2, 0.4, 1.4)));
  }
  for (const auto& building : {map, symmetric}) {
    Pipeline pipeline(building, {});
    int states[5] = {};
    const long before = allocations;
    for (const Scan& scan : scans) {
      for (const Sample& sample : scan.samples()) {
        const ScanResult* result = pipeline.add(sample);
        if (result != nullptr) ++states[static_cast<int>(result->pose.state)];
      }
    }
    EXPECT_EQ(allocations - before, 0);
    // Every branch of the step was taken.
    EXPECT_GT(
        states[static_cast<int>(PoseState::kFix)] + states[static_cast<int>(PoseState::kTracking)],
        building == map ? 0 : -1);
    EXPECT_GT(states[static_cast<int>(PoseState::kAmbiguous)], building == symmetric ? 0 : -1);
    EXPECT_GT(states[static_cast<int>(PoseState::kLost)], 0);
  }
}

TEST(Pipeline, ChoosingAMap_AllocatesNothing) {
  const std::vector<std::shared_ptr<const WallMap>> maps = {
      testing::make_map(testing::l_shaped_room()), testing::make_map(testing::two_equal_rooms()),
      testing::make_map(testing::rectangular_room(3, 2))};
  testing::ScanSource source(75);
  std::vector<Scan> scans;
  testing::ScanOptions options;
  for (int k = 0; k < 100; ++k) {
    options.start_ns = 137'000'000 * TimeNs{k};
    scans.push_back(source.take(*maps.front(), {0.5 + 0.03 * k, 0.6, 0.2}, options));
  }
  Pipeline pipeline(maps, {});
  const long before = allocations;
  for (int round = 0; round < 2; ++round) {
    for (const Scan& scan : scans) {
      for (const Sample& sample : scan.samples()) pipeline.add(sample);
    }
    EXPECT_EQ(pipeline.maps().map(), 0U);
    pipeline.maps().relocalize();
  }
  EXPECT_EQ(allocations - before, 0);
}

TEST(Pipeline, LearningWalls_AllocatesNothing) {
  FloorPlan plan = testing::l_shaped_room();
  plan.sigma_m = 0.03;
  const auto map = testing::make_map(plan);
  for (Wall& wall : plan.walls) {
    for (Vec2* end : {&wall.from, &wall.to}) end->y() += end->y() > 1.5 ? 0.03 : 0;
  }
  const auto building = testing::make_map(plan);
  testing::ScanSource source(72);
  std::vector<Scan> scans;
  testing::ScanOptions options;
  for (int k = 0; k < 60; ++k) {
    options.start_ns = std::int64_t{137'000'000} * k;
    scans.push_back(source.take(*building, {0.5 + 0.03 * k, 0.6, 0.2}, options));
  }
  LocalizerConfig config;
  config.learn_walls = true;
  Localizer localizer(map, config);
  const long before = allocations;
  for (const Scan& scan : scans) localizer.step(scan);
  EXPECT_EQ(allocations - before, 0);
  EXPECT_GT(localizer.walls()->size(), 4u);
}

TEST(Pipeline, SampleToPoseEachMethod_AllocatesNothing) {
  const auto map = testing::make_map(testing::l_shaped_room());
  for (const char* method : {"altbd", "altbd-printed", "abd-iepf", "lt"}) {
    LocalizerConfig config;
    config.detector.finder = baseline::wall_finder(method);
    Pipeline pipeline(map, config);
    testing::ScanSource source(72);
    testing::ScanOptions noisy;
    noisy.noise = {0.01, 0.03, radians(0.5)};
    noisy.missing_share = 0.3;
    noisy.samples = 2000;
    std::size_t segments = 0;
    for (int k = 0; k < 10; ++k) {
      const Pose2 T_map_lidar = source.place_in(0.4, 2.2, 0.4, 1.4);
      const Scan scan = source.take(*map, T_map_lidar, k % 2 == 0 ? testing::ScanOptions{} : noisy);
      const long before = allocations;
      for (const Sample& sample : scan.samples()) {
        const ScanResult* result = pipeline.add(sample);
        if (result != nullptr) segments += result->detection.segments.size();
      }
      EXPECT_EQ(allocations - before, 0) << method;
    }
    EXPECT_GT(segments, 0U) << method;
  }
}

TEST(Pipeline, OdometryAndPartialScans_AllocatesNothing) {
  const auto map = testing::make_map(testing::l_shaped_room());
  testing::ScanSource source(74);
  LocalizerConfig config;
  config.odometry.enabled = true;
  config.updates_per_scan = 4;
  Pipeline pipeline(map, config);
  std::vector<Scan> scans;
  testing::ScanOptions covered;
  covered.missing_share = 1;
  for (int k = 0; k < 30; ++k) {
    testing::ScanOptions options = k < 20 ? testing::ScanOptions{} : covered;
    options.start_ns = TimeNs{k} * 140'000'000;
    scans.push_back(source.take(*map, {1, 1, 0.5}, options));
  }
  int predicted = 0;
  int parts = 0;
  const long before = allocations;
  for (const Scan& scan : scans) {
    for (TimeNs dt_ns = 0; dt_ns < 140'000'000; dt_ns += 20'000'000) {
      pipeline.add(OdometryReading{scan.start_ns() + dt_ns, 5, 7, 0.001});
    }
    for (const Sample& sample : scan.samples()) {
      const ScanResult* result = pipeline.add(sample);
      predicted += result != nullptr && result->pose.state == PoseState::kPredicted;
      parts += pipeline.partial_pose() != nullptr;
    }
  }
  EXPECT_EQ(allocations - before, 0);
  EXPECT_GT(predicted, 5);
  EXPECT_GT(parts, 20);
}

TEST(Localizer, FirstScanWhileTurning_AllocatesNothing) {
  const auto map = testing::make_map(testing::l_shaped_room());
  testing::ScanSource source(75);
  testing::ScanOptions options;
  int named = 0;
  for (int k = 0; k < 10; ++k) {
    Localizer localizer(map, {});
    options.motion = Twist2{0.3, 0, k % 2 == 0 ? 2.2 : -2.2};
    const Scan scan = source.take(*map, source.place_in(0.4, 2.2, 0.4, 2.6), options);
    const long before = allocations;
    named += has_pose(localizer.step(scan).pose.state);
    EXPECT_EQ(allocations - before, 0);
  }
  EXPECT_GE(named, 8);
}

TEST(BreakpointStream, ReturnToBreakpoint_AllocatesNothing) {
  const auto map = testing::make_map(testing::l_shaped_room());
  testing::ScanSource source(73);
  for (const Sweep sweep : {Sweep::kCounterClockwise, Sweep::kClockwise}) {
    BreakpointStream stream({}, {});
    std::size_t found = 0;
    for (int k = 0; k < 10; ++k) {
      const Scan scan = source.take(*map, source.place_in(0.4, 2.2, 0.4, 1.4));
      const long before = allocations;
      stream.begin(kTwoPi / static_cast<double>(scan.size()), sweep);
      for (const Sample& sample : scan.samples()) {
        found += stream.add(sample.bearing_rad, sample.range_m).size();
      }
      found += stream.finish().size();
      EXPECT_EQ(allocations - before, 0);
    }
    EXPECT_EQ(found > 30, sweep == Sweep::kClockwise);  // the scans are clockwise
  }
}

TEST(Pipeline, AllocationCounter_Counts) {
  const long before = allocations;
  delete new int(3);
  EXPECT_GT(allocations - before, 0);
}

}  // namespace
}  // namespace cornerd::core
