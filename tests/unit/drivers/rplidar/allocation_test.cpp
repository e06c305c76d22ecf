// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>

#include "../allocation_counter.hpp"
#include "drivers/rplidar/sample_stream.hpp"
#include "wire_fixture.hpp"

namespace cornerd::rplidar::test {
namespace {

class CountingSink : public drivers::SampleSink {
 public:
  void on_sample(const core::Sample&) override { ++samples; }
  void on_gap() override {}
  std::size_t samples = 0;
};

TEST(SampleStream, DamagedStreamOfAllFormats_AllocatesNothing) {
  Bytes damaged_nodes = nodes(2000, 30);
  damaged_nodes.erase(damaged_nodes.begin() + 1234);
  damaged_nodes[5000] ^= 1;
  const Bytes stream =
      join({kStandardDescriptor, damaged_nodes, kExpressDescriptor, join(express_capsules(100, 5)),
            from_hex("a55a0300000006000000"), kUltraDescriptor, join(ultra_capsules(100, 5)),
            kDenseDescriptor, join(dense_capsules(100, 5)), kUltraDenseDescriptor,
            join(ultra_dense_capsules(100, 5)), kHqDescriptor, join(hq_packets(20, 5))});
  SampleStream samples({});
  CountingSink sink;
  const std::size_t before = cornerd::test::allocations();
  for (std::size_t i = 0; i < stream.size(); i += 61) {
    const auto piece = std::span(stream).subspan(i, std::min<std::size_t>(61, stream.size() - i));
    samples.feed(piece, static_cast<core::TimeNs>(i) * 86806, sink);
  }
  samples.finish(sink);
  EXPECT_EQ(cornerd::test::allocations() - before, 0U);
  EXPECT_GT(samples.samples(), 26000U) << "those of the fast formats have no time at this pace";
  EXPECT_GT(sink.samples, 14000U);
}

TEST(SampleStream, HeldSamples_AllocateNothing) {
  const Bytes stream = join({kStandardDescriptor, nodes(12000, 30)});
  constexpr core::TimeNs kByteNs = 101'600;
  SampleStream samples({});
  CountingSink sink;
  const std::size_t before = cornerd::test::allocations();
  std::size_t waited = 0;
  for (std::size_t i = 0; i < stream.size(); i += 60) {
    const auto piece = std::span(stream).subspan(i, std::min<std::size_t>(60, stream.size() - i));
    core::TimeNs now_ns = static_cast<core::TimeNs>(i) * kByteNs;
    // The device pauses after one third, and the reader stalls after two thirds.
    if (i > stream.size() / 3) now_ns += 300'000'000;
    if (i > 2 * stream.size() / 3) {
      now_ns = std::max(now_ns,
                        static_cast<core::TimeNs>(2 * stream.size() / 3) * kByteNs + 800'000'000);
    }
    samples.feed(piece, now_ns, sink);
    waited = std::max(waited, static_cast<std::size_t>(samples.samples()) - sink.samples);
  }
  EXPECT_EQ(cornerd::test::allocations() - before, 0U);
  EXPECT_GT(waited, 500U);
  EXPECT_GT(sink.samples, 11900U);
}

}  // namespace
}  // namespace cornerd::rplidar::test
