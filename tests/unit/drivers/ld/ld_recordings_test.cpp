// SPDX-License-Identifier: MIT
// Bytes of a real LD06 in $CORNERD_RECORDINGS/ld06, recorded by others and not part of the project.
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "drivers/ld/ld_decoder.hpp"
#include "frame_collector.hpp"

namespace cornerd::ld {
namespace {

namespace fs = std::filesystem;

TEST(LdRecordings, EveryFile_GivesAllItsPacketsAndRevolutions) {
  const char* folder = std::getenv("CORNERD_RECORDINGS");
  if (folder == nullptr || !fs::exists(fs::path(folder) / "ld06")) {
    GTEST_SKIP() << "CORNERD_RECORDINGS names no folder with ld06 in it";
  }
  drivers::StreamCounters sum;
  std::size_t gaps = 0;
  for (int n = 1; n <= 6; ++n) {
    std::ifstream stream(fs::path(folder) / "ld06" / ("data_" + std::to_string(n) + ".bin"),
                         std::ios::binary);
    const frame_test::Bytes bytes{std::istreambuf_iterator<char>(stream), {}};
    LdDecoder decoder;
    gaps += decode_all(decoder, bytes).gaps.size();
    EXPECT_EQ(decoder.counters().resyncs, 0U) << n;
    sum += decoder.counters();
  }
  EXPECT_EQ(sum.bytes, 20'876 * kPacketSize);
  EXPECT_EQ(sum.used_bytes, 20'872 * kPacketSize);
  EXPECT_EQ(sum.skipped_bytes, 4 * kPacketSize) << "each damaged packet must cost itself alone";
  EXPECT_EQ(sum.bad_checksums, 4U);
  EXPECT_EQ(sum.samples, 20'872 * kPacketSamples);
  EXPECT_EQ(sum.scans, 552U);
  // The recorder paused for 148 ms in file 2 and for 21 s in file 5; 29 ms more are counted.
  EXPECT_EQ(gaps, 2U);
}

}  // namespace
}  // namespace cornerd::ld
