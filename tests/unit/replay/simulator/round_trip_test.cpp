// SPDX-License-Identifier: MIT
// The decoder reads what the simulator sends.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <vector>

#include "drivers/rplidar/decoder.hpp"
#include "drivers/rplidar/sample_stream.hpp"
#include "replay/simulator/serial_line.hpp"
#include "replay/simulator/simulator.hpp"
#include "tests/unit/replay/test_maps.hpp"

namespace cornerd::replay {
namespace {

using rplidar::WireFormat;

struct Collector : rplidar::RawSampleSink, drivers::SampleSink {
  void on_sample(const rplidar::RawSample& sample) override { raw.push_back(sample); }
  void on_sample(const core::Sample& sample) override { timed.push_back(sample); }
  void on_gap() override { ++gaps; }
  std::vector<rplidar::RawSample> raw;
  std::vector<core::Sample> timed;
  int gaps = 0;
};

class RoundTrip : public ::testing::TestWithParam<WireFormat> {
 protected:
  static constexpr std::size_t kSamples = 6000;

  RoundTrip() {
    SimulatorConfig config;
    config.wire = GetParam();
    config.sensor.missing = 0.3;
    Simulator simulator(std::make_unique<MapScene>(make_room(), stand_still({0.6, 1.3, -2})),
                        config);
    Collector collector;
    rplidar::SampleStream stream({});
    rplidar::Decoder decoder;
    SerialLine line;
    decoder.feed(simulator.descriptor(), collector);
    stream.feed(simulator.descriptor(), line.send(0, 7), collector);
    while (sent_.size() < kSamples) {
      const WirePacket packet = simulator.next();
      decoder.feed(packet.bytes, collector);
      stream.feed(packet.bytes, line.send(packet.ready_ns, packet.bytes.size()), collector);
      sent_.insert(sent_.end(), packet.samples.begin(), packet.samples.end());
    }
    decoder.finish(collector);
    stream.finish(collector);
    counters_ = decoder.counters();
    received_ = std::move(collector.raw);
    timed_ = std::move(collector.timed);
    gaps_ = collector.gaps;
  }

  std::vector<SimulatedSample> sent_;
  std::vector<rplidar::RawSample> received_;
  std::vector<core::Sample> timed_;
  drivers::StreamCounters counters_;
  int gaps_ = 0;
};
INSTANTIATE_TEST_SUITE_P(Formats, RoundTrip,
                         ::testing::Values(WireFormat::kStandard, WireFormat::kExpress,
                                           WireFormat::kUltra));

TEST_P(RoundTrip, EverySample_IsDecodedAsSent) {
  // A capsule without a successor stays undecoded.
  ASSERT_GE(received_.size() + kUltraSamples, sent_.size());
  // The decoder's fixed point truncates angles; the vendor's series for the optics of ultra
  // capsules adds up to 0.06 degrees.
  const int tolerance_q6 = GetParam() == WireFormat::kStandard  ? 0
                           : GetParam() == WireFormat::kExpress ? 1
                                                                : 6;
  for (std::size_t i = 0; i < received_.size(); ++i) {
    ASSERT_EQ(received_[i].index, i);
    ASSERT_EQ(received_[i].dist_q2, sent_[i].dist_q2) << i;
    const int sent_q6 = static_cast<int>(std::lround(sent_[i].device_angle_deg * 64));
    const int apart_q6 = std::abs(sent_q6 - static_cast<int>(received_[i].angle_q6));
    ASSERT_LE(std::min(apart_q6, 360 * 64 - apart_q6), tolerance_q6) << i;
  }
}

TEST_P(RoundTrip, Scans_StartAtTheSameSample) {
  for (std::size_t i = 1; i < received_.size(); ++i) {
    ASSERT_EQ(received_[i].starts_scan, sent_[i].starts_scan) << i;
  }
}

TEST_P(RoundTrip, CleanStream_LosesNothing) {
  EXPECT_EQ(gaps_, 0);
  EXPECT_EQ(counters_.skipped_bytes, 0u);
  EXPECT_EQ(counters_.bad_checksums, 0u);
  EXPECT_EQ(counters_.lost_capsules, 0u);
  EXPECT_EQ(counters_.bad_nodes, 0u);
  EXPECT_EQ(counters_.resyncs, 0u);
  EXPECT_EQ(counters_.false_scan_starts, 0u);
}

TEST_P(RoundTrip, SampleTimes_AreWithinTwoPeriods) {
  // The delay between the last sample and its packet is known to one period.
  const core::TimeNs tolerance_ns = 2 * nominal_sample_period_ns(GetParam());
  ASSERT_EQ(timed_.size(), received_.size());
  for (std::size_t i = timed_.size() / 2; i < timed_.size(); ++i) {
    ASSERT_NEAR(static_cast<double>(timed_[i].t_ns - sent_[i].t_ns), 0,
                static_cast<double>(tolerance_ns))
        << i;
  }
}

TEST_P(RoundTrip, ToSample_EqualsTheStreamsSample) {
  for (std::size_t i = 1; i < timed_.size(); ++i) {
    const core::Sample expected = to_sample(sent_[i]);
    ASSERT_NEAR(core::angle_between(expected.bearing_rad, timed_[i].bearing_rad), 0, 0.0015);
    ASSERT_FLOAT_EQ(expected.range_m, timed_[i].range_m);
    ASSERT_EQ(expected.starts_scan, timed_[i].starts_scan);
  }
}

}  // namespace
}  // namespace cornerd::replay
