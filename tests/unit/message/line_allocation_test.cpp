// SPDX-License-Identifier: MIT
// Counts heap allocations while messages are written.
#include <gtest/gtest.h>

#include <array>
#include <atomic>
#include <cstdlib>
#include <new>

#include "core/scan.hpp"
#include "message/line_writer.hpp"

namespace {

std::atomic<bool> counting{false};
std::atomic<int> allocations{0};

}  // namespace

[[gnu::noinline]] void* operator new(std::size_t size) {
  if (counting) ++allocations;
  if (void* memory = std::malloc(size)) return memory;
  throw std::bad_alloc();
}
[[gnu::noinline]] void operator delete(void* memory) noexcept { std::free(memory); }
[[gnu::noinline]] void operator delete(void* memory, std::size_t /*size*/) noexcept {
  std::free(memory);
}

namespace cornerd::message {
namespace {

TEST(LineWriter, LongestLines_AllocateNothing) {
  LineWriter writer;
  core::Scan scan;
  for (std::size_t i = 0; i < core::kMaxSamplesPerScan; ++i) {
    // Irregular times add "times"; every field has its maximum length.
    scan.add({.t_ns = static_cast<core::TimeNs>(i * i * 100),
              .bearing_rad = -3.1234567f,
              .range_m = 39.12345f,
              .quality = 255});
  }
  core::Detection detection;
  detection.breakpoints.resize(core::kMaxBreakpointsPerScan);
  core::PoseEstimate pose;
  pose.alternatives.resize(core::kMaxAlternatives);
  const std::array<StatusFields::Counter, 1> counters = {{{"bytes", 7}}};
  StatusFields status;
  status.counters = counters;
  std::array<std::uint8_t, 4096> bytes{};

  counting = true;
  std::size_t written = writer.scan(scan).size();
  written += writer.breakpoints(0, detection).size();
  written += writer.pose(pose, nullptr).size();
  written += writer.status(status).size();
  written += writer.event(0, "what", "detail").size();
  written += writer.error("json", "text", "WATCH", "1").size();
  written += writer.serial(0, LineWriter::Direction::kRx, bytes).size();
  counting = false;

  EXPECT_GT(written, core::kMaxSamplesPerScan * 20) << "the scan must have its maximum length";
  EXPECT_EQ(allocations, 0);
}

}  // namespace
}  // namespace cornerd::message
