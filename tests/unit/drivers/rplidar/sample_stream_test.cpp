// SPDX-License-Identifier: MIT
#include "drivers/rplidar/sample_stream.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "wire_fixture.hpp"

namespace cornerd::rplidar::test {
namespace {

using testing::SizeIs;

class StreamedSamples : public drivers::SampleSink {
 public:
  void on_sample(const core::Sample& sample) override { all.push_back(sample); }
  void on_arrival(core::TimeNs arrival_ns) override {
    arrivals.emplace_back(all.size(), arrival_ns);
  }
  void on_gap() override { ++gaps; }
  std::vector<core::Sample> all;
  std::vector<std::pair<std::size_t, core::TimeNs>> arrivals;  ///< with the sample's index
  int gaps = 0;
};

StreamedSamples stream_untimed(const Bytes& bytes, const SampleStreamConfig& config) {
  SampleStream stream(config);
  StreamedSamples samples;
  stream.feed_untimed(bytes, samples);
  stream.finish(samples);
  return samples;
}

TEST(SampleStream, DeviceAngles_BecomeCounterClockwiseBearings) {
  const Bytes bytes =
      join({kStandardDescriptor, node(false, 15, 90, 1000), node(false, 15, 91, 0)});
  const auto upright = stream_untimed(bytes, {});
  ASSERT_THAT(upright.all, SizeIs(2));
  EXPECT_NEAR(upright.all[0].bearing_rad, -std::numbers::pi / 2, 1e-6);
  EXPECT_FLOAT_EQ(upright.all[0].range_m, 1.0F);
  EXPECT_EQ(upright.all[0].quality, 15);
  EXPECT_EQ(upright.all[1].range_m, 0);
  const auto inverted = stream_untimed(bytes, {.format = {}, .inverted = true});
  EXPECT_NEAR(inverted.all[0].bearing_rad, std::numbers::pi / 2, 1e-6);
}

TEST(SampleStream, Bearings_StayWithinPi) {
  for (const bool inverted : {false, true}) {
    const auto samples = stream_untimed(nodes(400, 100, 1), {.format = {}, .inverted = inverted});
    for (const core::Sample& sample : samples.all) {
      EXPECT_LE(std::abs(static_cast<double>(sample.bearing_rad)), std::numbers::pi);
    }
  }
}

TEST(SampleStream, UntimedBytes_AreTimedByIndex) {
  const auto standard = stream_untimed(nodes(1000, 30), {});
  EXPECT_EQ(standard.all[0].t_ns, 0);
  EXPECT_EQ(standard.all[999].t_ns, 999 * 508'000);
  const auto express = stream_untimed(join(express_capsules(20, 5)), {});
  EXPECT_EQ(express.all[600].t_ns, 600 * 254'000);
  const auto ultra = stream_untimed(join(ultra_capsules(20, 5)), {});
  EXPECT_EQ(ultra.all[600].t_ns, 600 * 127'000);
  const auto stability = stream_untimed(
      join(ultra_capsules(20, 5)), {.format = {}, .inverted = false, .sample_period_s = 201e-6});
  EXPECT_EQ(stability.all[600].t_ns, 600 * 201'000);
}

TEST(SampleStream, ImplausiblePeriod_IsReplacedByTheNominalOne) {
  // 254 us with one bit wrong (Q8 in 32 bits), almost 0, negative.
  for (const double period_s : {254e-6 + 0.262144, 1e-9, -1.0}) {
    const auto express =
        stream_untimed(join(express_capsules(20, 5)),
                       {.format = {}, .inverted = false, .sample_period_s = period_s});
    EXPECT_EQ(express.all[600].t_ns, 600 * 254'000) << period_s;
  }
}

TEST(SampleStream, LostNode_TakesItsSamplePeriod) {
  Bytes bytes = nodes(400, 30);
  bytes.erase(bytes.begin() + 1002);
  EXPECT_EQ(stream_untimed(bytes, {}).all.back().t_ns, 399 * 508'000);
}

/// A sample's packet arrives when the next capsule is complete, however late it is read.
TEST(SampleStream, LateReads_ArrivalIsThatOfTheLastByte) {
  constexpr double kByteS = 10.0 / 115200;
  constexpr double kPeriodS = 254e-6;
  const auto capsules = express_capsules(1000, 5, 21.4);
  SampleStream stream({.format = WireFormat::kExpress});
  StreamedSamples samples;
  for (std::size_t c = 0; c < capsules.size(); ++c) {
    const double sent_s = 1 + (32.0 * static_cast<double>(c) + 31 + 1.5) * kPeriodS;
    const double last_byte_s = sent_s + kByteS * static_cast<double>(capsules[c].size());
    stream.feed(capsules[c], core::from_seconds(last_byte_s + 4e-3 * (c % 3 == 0)), samples);
  }
  ASSERT_GT(samples.arrivals.size(), 50U);
  for (const auto& [sample, arrival_ns] : samples.arrivals) {
    if (sample < 8000) continue;
    const auto capsule = static_cast<double>(sample / 32 + 1);
    const double true_s = 1 + (32 * capsule + 31 + 1.5) * kPeriodS + kByteS * 84;
    ASSERT_NEAR(core::to_seconds(arrival_ns), true_s, 1e-4) << sample;
  }
}

/// Capsules on a wire of 115200 baud, read in blocks that do not match them.
TEST(SampleStream, TimedBytes_GiveMeasurementTimesWithinAMillisecond) {
  constexpr double kByteS = 10.0 / 115200;
  constexpr double kPeriodS = 254e-6;
  const auto capsules = express_capsules(1000, 5, 21.4);
  SampleStream stream({.format = WireFormat::kExpress});
  StreamedSamples samples;
  Bytes waiting;
  double last_byte_s = 0;
  for (std::size_t c = 0; c < capsules.size(); ++c) {
    // Sent 1.5 periods after the last sample of capsule c.
    const double sent_s = 1 + (32.0 * static_cast<double>(c) + 31 + 1.5) * kPeriodS;
    for (std::size_t i = 0; i < capsules[c].size(); ++i) {
      waiting.push_back(capsules[c][i]);
      last_byte_s = sent_s + kByteS * static_cast<double>(i + 1);
      if (waiting.size() < 100) continue;
      stream.feed(waiting, core::from_seconds(last_byte_s + 1e-3 * (c % 3 == 0)), samples);
      waiting.clear();
    }
  }
  ASSERT_GT(samples.all.size(), 30000U);
  for (std::size_t i = 8000; i < samples.all.size(); ++i) {
    const double true_s = 1 + static_cast<double>(i) * kPeriodS;
    ASSERT_NEAR(core::to_seconds(samples.all[i].t_ns), true_s, 1e-3) << i;
  }
  EXPECT_EQ(stream.counters().clock_resets, 0U);
}

/// Feeds nodes in pieces of 80 bytes and knows each node's true time.
class FedNodes {
 public:
  void run(int pieces, core::TimeNs late_ns = 0) {
    for (int i = 0; i < pieces; ++i) {
      Bytes bytes;
      for (int k = 0; k < 16; ++k) {
        truth_ns_ += kNodeNs;
        const Bytes one = node(number_ % 360 == 0, 15, number_ % 360, 1000 + number_ % 1000);
        ++number_;
        bytes.insert(bytes.end(), one.begin(), one.end());
        truths_.push_back(truth_ns_);
      }
      now_ns_ = std::max(now_ns_, truth_ns_ + late_ns);
      stream_.feed(bytes, now_ns_, samples_);
    }
  }
  /// The device does not measure for so long.
  void pause(core::TimeNs pause_ns) { truth_ns_ += pause_ns; }
  /// The largest error of a sample's time. Ranges identify samples within half a second.
  core::TimeNs worst_error_ns() const {
    core::TimeNs worst_ns = 0;
    for (const core::Sample& sample : samples_.all) {
      core::TimeNs least_ns = std::numeric_limits<core::TimeNs>::max();
      const auto first = static_cast<std::size_t>(std::lround(1000 * sample.range_m)) - 1000;
      for (std::size_t i = first; i < truths_.size(); i += 1000) {
        least_ns = std::min(least_ns, std::abs(sample.t_ns - truths_[i] + kSentNs));
      }
      worst_ns = std::max(worst_ns, least_ns);
    }
    return worst_ns;
  }
  const StreamedSamples& samples() const { return samples_; }
  const drivers::StreamCounters& counters() const { return stream_.counters(); }

 private:
  static constexpr core::TimeNs kNodeNs = 508'000;
  static constexpr core::TimeNs kSentNs = 1'196'000;
  SampleStream stream_{{.format = WireFormat::kStandard}};
  StreamedSamples samples_;
  core::TimeNs truth_ns_ = core::kNsPerSecond;
  core::TimeNs now_ns_ = 0;
  std::vector<core::TimeNs> truths_;
  int number_ = 0;
};

TEST(SampleStream, DevicePause_NoSampleHasATimeWithinIt) {
  FedNodes nodes;
  nodes.run(100);
  nodes.pause(300'000'000);
  nodes.run(100);
  EXPECT_LT(nodes.worst_error_ns(), 10'000'000);
  EXPECT_EQ(nodes.samples().gaps, 1);
  EXPECT_GT(nodes.samples().all.size(), 3100U);
}

TEST(SampleStream, UntimedSamples_CountThoseNotDelivered) {
  FedNodes nodes;
  const auto expect_all_counted = [&](std::uint64_t least_untimed) {
    const drivers::StreamCounters& counters = nodes.counters();
    EXPECT_EQ(counters.samples, nodes.samples().all.size() + counters.untimed_samples);
    EXPECT_GE(counters.untimed_samples, least_untimed);
  };
  nodes.run(100);
  expect_all_counted(0);
  nodes.run(1, core::kNsPerSecond / 5);
  expect_all_counted(16);
  nodes.run(100);
  expect_all_counted(0);
  nodes.pause(300'000'000);
  nodes.run(1);
  expect_all_counted(16);
}

TEST(SampleStream, StalledReader_AllSamplesHaveTheirTimes) {
  FedNodes nodes;
  nodes.run(100);
  nodes.run(1, 2 * core::kNsPerSecond);
  nodes.run(400);
  EXPECT_LT(nodes.worst_error_ns(), 10'000'000);
  EXPECT_EQ(nodes.samples().gaps, 0);
  EXPECT_GT(nodes.samples().all.size(), 7900U);
}

}  // namespace
}  // namespace cornerd::rplidar::test
