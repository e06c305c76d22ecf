// SPDX-License-Identifier: MIT
#include "message/odometry_input_monitor.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <utility>

namespace cornerd::message {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;

class OdometryInputMonitorTest : public ::testing::Test {
 protected:
  OdometryInputMonitorTest() {
    summary_.enabled = true;
    static_cast<void>(hint());
  }
  void add(const core::OdometryReading& reading, int times = 50) {
    for (int i = 0; i < times; ++i) monitor_.add(reading);
  }
  /// The hint one second later.
  std::string hint() {
    t_ns_ += core::kNsPerSecond;
    monitor_.update(summary_.counters, t_ns_);
    return std::string(monitor_.hint(summary_.present));
  }

  OdometryInputMonitor monitor_;
  core::OdometrySummary summary_;
  core::TimeNs t_ns_ = 0;
};

TEST_F(OdometryInputMonitorTest, MissingFields_NamedInHint) {
  EXPECT_THAT(hint(), HasSubstr("no ODOMETRY line"));
  add({0, {}, {}, 0.1});
  EXPECT_THAT(hint(), HasSubstr("lack left and right: a gyro"));
  add({0, 1, {}, 0.1});
  EXPECT_THAT(hint(), HasSubstr("lack right"));
  add({0, {}, 1, {}});
  EXPECT_THAT(hint(), HasSubstr("lack left:"));
  add({0, 1, {}, {}});
  add({0, {}, 1, {}});
  EXPECT_THAT(hint(), HasSubstr("left or right: send both counts in one line"));
}

TEST_F(OdometryInputMonitorTest, RefusedLines_CauseInHintAndCounted) {
  summary_.present = true;  // as it still is when the client changes
  add({0, 1, 1, {}}, 10);
  for (const char* line : {R"({"class":"ODOMETRY","left":1.5,"right":2})",
                           R"({"class":"ODOMETRY","left":"1","right":2})",
                           R"({"class":"ODOMETRY","t":1795161601180,"left":1,"right":2})",
                           R"({"class":"ODOMETRY"})", R"({"class":"ODOMETRY","gyro":NaN})"}) {
    const Request request = parse_request(line);
    const auto* error = std::get_if<RequestError>(&request.body);
    ASSERT_NE(error, nullptr) << line;
    for (int i = 0; i < 50; ++i) monitor_.refuse(*error);
    EXPECT_THAT(hint(), HasSubstr("lines are refused: " + error->text)) << line;
    EXPECT_EQ(monitor_.fault(), "odometry-refused");
  }
  for (const auto& [cause, count] : monitor_.refusals()) {
    EXPECT_EQ(count, cause == FieldReader::kOther ? 0u : 50u) << cause;
  }
  add({0, 1, 1, {}});
  EXPECT_THAT(hint(), IsEmpty());
}

TEST_F(OdometryInputMonitorTest, RejectedLines_CauseInHint) {
  add({0, 1, 1, {}});
  EXPECT_THAT(hint(), IsEmpty());
  for (int i = 0; i < 50; ++i) add({i, 1, 1, {}}, 1);
  summary_.counters.future += 40;
  EXPECT_THAT(hint(), HasSubstr("ahead of the lidar's"));
  for (int i = 0; i < 50; ++i) add({i, 1, 1, {}}, 1);
  summary_.counters.past += 40;
  EXPECT_THAT(hint(), HasSubstr("behind the lidar's"));
  add({0, 1, 1, {}});
  summary_.counters.jumps += 40;
  EXPECT_THAT(hint(), HasSubstr("/advanced/odometry/max_speed"));
}

TEST_F(OdometryInputMonitorTest, UsableLinesWithoutEffect_CauseInHint) {
  const auto late = [&](core::TimeNs by_ns) {
    // The time of the next hint, less the delay.
    return core::OdometryReading{t_ns_ + core::kNsPerSecond - by_ns, 1, 1, {}};
  };
  add(late(0));
  EXPECT_THAT(hint(), IsEmpty()) << "lines have just begun";
  add(late(core::kNsPerSecond / 2));
  EXPECT_THAT(hint(), HasSubstr("0.5 s behind the lidar's clock"));
  add(late(0), 1);
  EXPECT_THAT(hint(), HasSubstr("too rarely (1 in"));
  add(late(0));
  EXPECT_THAT(hint(), IsEmpty()) << "no scan yet: the lidar's fault says why";
}

TEST_F(OdometryInputMonitorTest, ALineEachTwoSeconds_IsTooRare) {
  for (int i = 0; i < 3; ++i) {
    add({t_ns_, 1, 1, {}}, 1);
    static_cast<void>(hint());
    EXPECT_THAT(hint(), HasSubstr("too rarely"));
  }
  add({t_ns_, 1, 1, {}}, 1);
  EXPECT_THAT(hint(), HasSubstr("too rarely"));
  for (int i = 0; i < 5; ++i) static_cast<void>(hint());
  EXPECT_THAT(hint(), HasSubstr("no ODOMETRY line"));
}

TEST_F(OdometryInputMonitorTest, ProgramThatEnds_IsNotTooRare) {
  add({t_ns_, 1, 1, {}});
  static_cast<void>(hint());
  EXPECT_THAT(hint(), HasSubstr("no ODOMETRY line"));
}

TEST_F(OdometryInputMonitorTest, TimeInWholeSeconds_IsNamed) {
  add({t_ns_, 1, 1, {}});
  summary_.counters.past += 20;
  summary_.counters.future += 20;
  EXPECT_THAT(hint(), HasSubstr("repeats: send the time of each reading with its fractions"));
}

TEST_F(OdometryInputMonitorTest, MostValuesRejected_Reported) {
  const auto counts_and_gyro = [&](int past, int jumps, int gyro) {
    add({0, 1, 1, 0.1});
    summary_.counters.past += past;
    summary_.counters.jumps += jumps;
    summary_.counters.invalid_rates += gyro;
    static_cast<void>(hint());
    return std::pair(monitor_.rejected().counts, monitor_.rejected().gyro);
  };
  EXPECT_EQ(counts_and_gyro(20, 20, 20), std::pair(false, false));
  EXPECT_EQ(counts_and_gyro(40, 0, 0), std::pair(true, true));
  EXPECT_EQ(counts_and_gyro(0, 40, 0), std::pair(true, false));
  EXPECT_EQ(counts_and_gyro(0, 0, 40), std::pair(false, true));
  static_cast<void>(hint());
  EXPECT_FALSE(monitor_.rejected().counts) << "no lines arrive";
  summary_.counters = {};
  EXPECT_EQ(counts_and_gyro(0, 0, 0), std::pair(false, false)) << "counters were reset";
}

TEST_F(OdometryInputMonitorTest, OdometryPresent_NoHint) {
  summary_.present = true;
  add({0, {}, {}, 0.1});
  EXPECT_THAT(hint(), IsEmpty());
}

TEST_F(OdometryInputMonitorTest, TwoCallsWithinInterval_SameHint) {
  add({0, {}, 1, {}});
  const std::string first = hint();
  monitor_.update(summary_.counters, t_ns_ + 1000);
  EXPECT_EQ(monitor_.hint(false), first);
  monitor_.update(summary_.counters, t_ns_ - core::kNsPerSecond);
  EXPECT_EQ(monitor_.hint(false), first) << "the clock was set back";
}

}  // namespace
}  // namespace cornerd::message
