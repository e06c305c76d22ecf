// SPDX-License-Identifier: MIT
#include "daemon/map_examiner.hpp"

#include <gtest/gtest.h>

#include <utility>

namespace cornerd::daemon {
namespace {

TEST(MapExaminer, MapChangedDuringExamination_ItsEndIsNotTakenForAnother) {
  core::FloorPlan plan;
  plan.walls = {{.from = {0, 0}, .to = {2, 0}}, {.from = {2, 0}, .to = {2, 1}}};
  const core::WallMap map(std::move(plan));
  MapExaminer examiner;
  for (int second = 0; second < 20; ++second) {
    ScanReport report;
    report.scan.add({.t_ns = (2 * second + 1) * core::kNsPerSecond, .range_m = 1});
    examiner.observe(report);
  }
  examiner.update(true, &map);
  examiner.configure({});  // waits for the thread, which has ended its examination or stopped it
  EXPECT_FALSE(examiner.update(true, &map));
  EXPECT_FALSE(examiner.update(false, nullptr));
}

}  // namespace
}  // namespace cornerd::daemon
