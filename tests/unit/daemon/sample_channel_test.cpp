// SPDX-License-Identifier: MIT
#include "daemon/sample_channel.hpp"

#include <gtest/gtest.h>

#include <thread>

namespace cornerd::daemon {
namespace {

using Kind = SampleChannel::Kind;
using WhenFull = SampleChannel::WhenFull;

core::Sample sample(core::TimeNs t_ns, bool starts_scan = false) {
  return {.t_ns = t_ns, .starts_scan = starts_scan};
}

TEST(SampleChannel, SamplesAndGaps_KeepOrder) {
  SampleChannel channel(WhenFull::kLose);
  channel.on_sample(sample(1, true));
  channel.on_gap();
  channel.on_sample(sample(2));
  SampleChannel::Item item;
  ASSERT_TRUE(channel.pop(item));
  EXPECT_EQ(item.sample.t_ns, 1);
  EXPECT_GT(item.arrival_ns, 0);
  ASSERT_TRUE(channel.pop(item));
  EXPECT_EQ(item.kind, Kind::kGap);
  ASSERT_TRUE(channel.pop(item));
  EXPECT_EQ(item.sample.t_ns, 2);
  EXPECT_FALSE(channel.pop(item));
}

TEST(SampleChannel, NewestTime_OfLastSampleEvenIfNotPopped) {
  SampleChannel channel(WhenFull::kLose);
  EXPECT_EQ(channel.newest_ns(), 0);
  channel.on_sample(sample(5, true));
  channel.on_sample(sample(8));
  channel.on_gap();
  EXPECT_EQ(channel.newest_ns(), 8);
}

TEST(SampleChannel, SampleThatMayCompleteScan_WakesConsumer) {
  SampleChannel channel(WhenFull::kLose);
  const std::uint32_t before = channel.wakes();
  channel.on_sample(sample(1));
  EXPECT_EQ(channel.wakes(), before);
  channel.on_sample(sample(2, true));
  EXPECT_EQ(channel.wakes(), before + 1);
  channel.on_sample({.t_ns = 3, .ends_scan = true});
  EXPECT_EQ(channel.wakes(), before + 2);
  channel.on_gap();
  EXPECT_EQ(channel.wakes(), before + 3);
}

TEST(SampleChannel, ForParts_WakesConsumerWithinScan) {
  SampleChannel channel(WhenFull::kLose);
  channel.wake_for_parts(true);
  channel.on_sample(sample(1, true));
  const std::uint32_t before = channel.wakes();
  channel.on_sample(sample(9'000'000));
  EXPECT_EQ(channel.wakes(), before);
  channel.on_sample(sample(11'000'000));
  EXPECT_EQ(channel.wakes(), before + 1);
}

TEST(SampleChannel, ArrivalOfLastByte_IsThatOfTheNextSample) {
  SampleChannel channel(WhenFull::kLose);
  channel.on_arrival(7);
  channel.on_sample(sample(1, true));
  channel.on_sample(sample(2, true));
  SampleChannel::Item item;
  ASSERT_TRUE(channel.pop(item));
  EXPECT_EQ(item.arrival_ns, 7);
  EXPECT_GT(item.passed_ns, 7);
  ASSERT_TRUE(channel.pop(item));
  EXPECT_EQ(item.arrival_ns, item.passed_ns);
}

TEST(SampleChannel, StreamWithoutScanStarts_WakesBeforeRingIsFull) {
  SampleChannel channel(WhenFull::kLose);
  const std::uint32_t before = channel.wakes();
  while (channel.lost() == 0 && channel.wakes() == before) channel.on_sample(sample(1));
  EXPECT_EQ(channel.lost(), 0u);
}

TEST(SampleChannel, SlowConsumer_NewSamplesLostAndGap) {
  SampleChannel channel(WhenFull::kLose);
  core::TimeNs pushed = 0;
  while (channel.lost() < 10) channel.on_sample(sample(++pushed));
  SampleChannel::Item item;
  core::TimeNs popped = 0;
  while (channel.pop(item)) {
    ASSERT_EQ(item.kind, Kind::kSample);
    ASSERT_EQ(item.sample.t_ns, ++popped) << "no sample is missing in the ring";
  }
  EXPECT_EQ(popped, pushed - 10);
  channel.on_sample(sample(++pushed));
  ASSERT_TRUE(channel.pop(item));
  EXPECT_EQ(item.kind, Kind::kGap);
  ASSERT_TRUE(channel.pop(item));
  EXPECT_EQ(item.sample.t_ns, pushed);
}

TEST(SampleChannel, Recording_SlowConsumer_NothingLost) {
  constexpr core::TimeNs kSamples = 200'000;
  SampleChannel channel(WhenFull::kWait);
  std::jthread producer([&channel] {
    for (core::TimeNs i = 0; i < kSamples; ++i) channel.on_sample(sample(i, i % 100 == 0));
    channel.on_gap();
  });
  core::TimeNs expected = 0;
  for (bool ended = false; !ended;) {
    const std::uint32_t seen = channel.wakes();
    SampleChannel::Item item;
    while (channel.pop(item)) {
      ended = item.kind == Kind::kGap;
      if (!ended) {
        ASSERT_EQ(item.sample.t_ns, expected);
        ++expected;
      }
    }
    if (!ended) channel.wait(seen);
  }
  EXPECT_EQ(expected, kSamples);
  EXPECT_EQ(channel.lost(), 0u);
}

TEST(SampleChannel, Close_WaitingProducer_Ends) {
  SampleChannel channel(WhenFull::kWait);
  std::jthread producer([&channel] {
    for (int i = 0; i < 100'000; ++i) channel.on_sample(sample(i));
  });
  channel.close();
  producer.join();
  EXPECT_GT(channel.lost(), 0u);
}

}  // namespace
}  // namespace cornerd::daemon
