// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "drivers/stream/status_board.hpp"

namespace cornerd::drivers {
namespace {

using std::chrono::milliseconds;

class NoSink : public SampleSink {
 public:
  void on_sample(const core::Sample& /*sample*/) override {}
  void on_gap() override {}
};

constexpr core::TimeNs ms(core::TimeNs value) { return value * 1'000'000; }

/// A head of 10 revolutions a second that starts a scan at 100 ms, 200 ms, ...
class SampleMonitorTest : public ::testing::Test {
 protected:
  void scan_starts(core::TimeNs t_ns) {
    monitor_.on_sample({.t_ns = t_ns, .range_m = 1, .starts_scan = true});
  }

  StatusBoard board_;
  NoSink sink_;
  SampleMonitor monitor_{sink_, board_};
};

TEST_F(SampleMonitorTest, UnknownDuration_CollectsBriefly) {
  EXPECT_EQ(monitor_.collecting_time(ms(100)), milliseconds(3));
  scan_starts(ms(100));
  EXPECT_EQ(monitor_.collecting_time(ms(101)), milliseconds(3));
}

TEST_F(SampleMonitorTest, WithinScan_CollectsForLong_AndBrieflyWhereItsEndIsDue) {
  scan_starts(ms(100));
  scan_starts(ms(200));
  EXPECT_EQ(monitor_.collecting_time(ms(210)), milliseconds(10));
  EXPECT_EQ(monitor_.collecting_time(ms(289)), milliseconds(6)) << "no longer than until it is due";
  EXPECT_EQ(monitor_.collecting_time(ms(295)), milliseconds(3));
  EXPECT_EQ(monitor_.collecting_time(ms(400)), milliseconds(3)) << "the head has become slower";
}

TEST_F(SampleMonitorTest, SamplesThatArriveLate_EndIsDueWhereItArrives) {
  for (const core::TimeNs t_ns : {ms(100), ms(200)}) {
    monitor_.on_arrival(t_ns + ms(20));
    scan_starts(t_ns);
  }
  EXPECT_EQ(monitor_.collecting_time(ms(300)), milliseconds(10));
  EXPECT_EQ(monitor_.collecting_time(ms(309)), milliseconds(6));
  EXPECT_EQ(monitor_.collecting_time(ms(320)), milliseconds(3));
}

TEST_F(SampleMonitorTest, SamplesWithoutARevolution_AreAFaultUntilThereIsOne) {
  scan_starts(ms(100));
  for (core::TimeNs t_ns = 200; t_ns <= 3100; t_ns += 100) {
    EXPECT_EQ(monitor_.fault(), LidarFault::kNone) << t_ns;
    monitor_.on_sample({.t_ns = ms(t_ns), .range_m = 1});
    monitor_.on_gap();
  }
  monitor_.on_sample({.t_ns = ms(3101), .range_m = 1});
  EXPECT_EQ(monitor_.fault(), LidarFault::kNoScan);
  scan_starts(ms(3200));
  EXPECT_EQ(monitor_.fault(), LidarFault::kNone);
}

TEST_F(SampleMonitorTest, AfterGap_DurationIsUnknown) {
  scan_starts(ms(100));
  scan_starts(ms(200));
  monitor_.on_gap();
  EXPECT_EQ(monitor_.collecting_time(ms(210)), milliseconds(3));
}

}  // namespace
}  // namespace cornerd::drivers
