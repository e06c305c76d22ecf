// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

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

TEST(SampleStream, FromBytesToSamples_AllocatesNothing) {
  Bytes damaged_nodes = nodes(2000, 30);
  damaged_nodes.erase(damaged_nodes.begin() + 1234);
  damaged_nodes[5000] ^= 1;
  const Bytes stream =
      join({kStandardDescriptor, damaged_nodes, kExpressDescriptor, join(express_capsules(100, 5)),
            from_hex("a55a0300000006000000"), kUltraDescriptor, join(ultra_capsules(100, 5))});
  SampleStream samples({});
  CountingSink sink;
  const std::size_t before = cornerd::test::allocations();
  for (std::size_t i = 0; i < stream.size(); i += 61) {
    const auto piece = std::span(stream).subspan(i, std::min<std::size_t>(61, stream.size() - i));
    samples.feed(piece, static_cast<core::TimeNs>(i) * 86806, sink);
  }
  samples.finish(sink);
  EXPECT_EQ(cornerd::test::allocations() - before, 0U);
  EXPECT_GT(sink.samples, 14000U);
}

}  // namespace
}  // namespace cornerd::rplidar::test
