// SPDX-License-Identifier: MIT
#include "bench/workload.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "bench/instruction_counter.hpp"
#include "replay/simulator/scan_simulator.hpp"
#include "tests/unit/replay/test_maps.hpp"

namespace cornerd::bench {
namespace {

std::vector<core::Scan> room_scans(std::size_t samples) {
  replay::ScanSimulator simulator({}, samples, 1);
  return {simulator.take(*replay::make_room(), {1, 1, 0}),
          simulator.take(*replay::make_room(), {1.5, 2, 1})};
}

TEST(Workload, Run_DetectsInThatScan) {
  const auto scans = room_scans(800);
  Workload workload(paper_methods().front(), scans);
  ASSERT_EQ(workload.scans(), 2u);
  workload.run(1);
  ASSERT_EQ(workload.detection().breakpoints.size(), 4u);
  const core::Vec2 second = workload.detection().breakpoints.front().position;
  workload.run(0);
  EXPECT_NE(workload.detection().breakpoints.front().position, second);
}

TEST(Workload, EachScan_IsTimed) {
  const auto scans = room_scans(400);
  Workload workload(paper_methods().front(), scans);
  const auto times_us = time_scans_us(workload, 9);
  ASSERT_EQ(times_us.size(), 2u);
  for (const double time_us : times_us) EXPECT_GT(time_us, 0);
  EXPECT_GT(time_preparation_us(scans, 3), 0);
}

TEST(InstructionCounter, Available_CountsWork) {
  InstructionCounter counter;
  volatile unsigned sum = 0;
  const auto work = [&](unsigned steps) {
    return counter.count([&] {
      for (unsigned i = 0; i < steps; ++i) sum = sum + i;
    });
  };
  const auto some = work(1'000);
  const auto more = work(100'000);
  EXPECT_EQ(some.has_value(), counter.is_available());
  if (!counter.is_available()) GTEST_SKIP() << "no performance counter for this user";
  EXPECT_GT(*more, *some + 99'000);
}

}  // namespace
}  // namespace cornerd::bench
