// SPDX-License-Identifier: MIT
#include "replay/replay_driver.hpp"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <atomic>
#include <chrono>
#include <fstream>
#include <string>
#include <thread>
#include <vector>

#include "core/ring_buffer.hpp"
#include "tests/temporary_folder.hpp"

namespace cornerd::replay {
namespace {

using drivers::LidarState;

struct PlayedSamples : drivers::SampleSink {
  void on_sample(const core::Sample& sample) override {
    samples.push_back(sample);
    if (samples.size() == stop_after) stop.request_stop();
  }
  void on_gap() override { ++gaps; }
  std::vector<core::Sample> samples;
  int gaps = 0;
  std::size_t stop_after = 0;
  std::stop_source stop;
};

/// Two scans of four samples, 0.1 s each.
std::filesystem::path write_recording(const test::TemporaryFolder& folder) {
  const std::filesystem::path file = folder.path() / "a.ndjson";
  std::ofstream stream(file);
  for (const char* t : {"5.0", "5.1"}) {
    stream << R"({"class":"SCAN","t":)" << t
           << R"(,"duration":0.1,"angles":[1,0.5,0,-0.5],"ranges":[1,0,2,3]})"
           << "\n";
  }
  return file;
}

TEST(ReplayDriver, Recording_KeepsItsTimesAndEnds) {
  const test::TemporaryFolder folder;
  ReplayDriver driver({write_recording(folder), 0, false, {}});
  PlayedSamples sink;
  driver.run({}, sink);
  ASSERT_EQ(sink.samples.size(), 8u);
  EXPECT_EQ(sink.samples[0].t_ns, 5 * core::kNsPerSecond);
  EXPECT_EQ(sink.gaps, 0);
  const drivers::LidarStatus status = driver.status();
  EXPECT_EQ(status.state, LidarState::kEnded);
  EXPECT_EQ(status.counters.samples, 8u);
  EXPECT_EQ(status.counters.scans, 2u);
  EXPECT_NEAR(status.rate_hz, 10, 1e-6);
  EXPECT_NEAR(status.samples_hz, 40, 1e-6);
}

TEST(ReplayDriver, Loop_TimeKeepsGrowingEvenly) {
  const test::TemporaryFolder folder;
  ReplayDriver driver({write_recording(folder), 0, true, {}});
  PlayedSamples sink;
  sink.stop_after = 28;
  driver.run(sink.stop.get_token(), sink);
  ASSERT_EQ(sink.samples.size(), 28u);
  EXPECT_EQ(sink.gaps, 3);
  for (std::size_t i = 1; i < sink.samples.size(); ++i) {
    EXPECT_EQ(sink.samples[i].t_ns - sink.samples[i - 1].t_ns, 25'000'000) << i;
  }
  EXPECT_EQ(driver.status().counters.scans, 7u);
}

TEST(ReplayDriver, Speed2_PacesTheSamples) {
  const test::TemporaryFolder folder;
  ReplayDriver driver({write_recording(folder), 2, false, {}});
  PlayedSamples sink;
  const auto begin = std::chrono::steady_clock::now();
  driver.run({}, sink);
  // 0.175 s from the first sample to the last, at twice the speed; a slow machine may take longer.
  EXPECT_GE(std::chrono::steady_clock::now() - begin, std::chrono::milliseconds(87));
  EXPECT_EQ(sink.samples.size(), 8u);
}

TEST(ReplayDriver, Stop_EndsAWait) {
  const test::TemporaryFolder folder;
  ReplayDriver driver({write_recording(folder), 1e-6, false, {}});  // 25 ms become seven hours
  PlayedSamples sink;
  sink.stop_after = 1;
  driver.run(sink.stop.get_token(), sink);
  EXPECT_EQ(sink.samples.size(), 1u);
}

TEST(ReplayDriver, Unpaced_WaitsForASlowConsumer) {
  struct RingSink : drivers::SampleSink {
    void on_sample(const core::Sample& sample) override {
      ring.push(sample);
      ++delivered;
    }
    void on_gap() override {}
    bool ready() const override { return delivered - consumed.load() < ring.capacity(); }
    core::RingBuffer<core::Sample> ring{4};
    std::size_t delivered = 0;
    std::atomic<std::size_t> consumed{0};
  };
  const test::TemporaryFolder folder;
  ReplayDriver driver({write_recording(folder), 0, false, {}});
  RingSink sink;
  std::jthread consumer([&](const std::stop_token& stop) {
    core::Sample sample;
    while (!stop.stop_requested()) {
      if (sink.ring.pop(sample)) {
        ++sink.consumed;
      } else {
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
      }
    }
  });
  driver.run({}, sink);
  EXPECT_EQ(sink.delivered, 8u);
  EXPECT_EQ(sink.ring.overflows(), 0u);
}

TEST(ReplayDriver, UnreadableFile_IsFaultyWithItsName) {
  ReplayDriver driver({"/nonexistent/a.bin", 1, true, {}});
  PlayedSamples sink;
  driver.run({}, sink);
  const drivers::LidarStatus status = driver.status();
  EXPECT_EQ(status.state, LidarState::kFaulty);
  EXPECT_NE(status.detail.view().find("/nonexistent/a.bin"), std::string::npos);
}

TEST(ReplayDriver, PipeWithoutWriter_IsFaultyWithItsName) {
  const test::TemporaryFolder folder;
  const std::filesystem::path pipe = folder / "pipe";
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  ReplayDriver driver({pipe, 1, false, {}});
  PlayedSamples sink;
  driver.run({}, sink);
  EXPECT_EQ(driver.status().state, LidarState::kFaulty);
  EXPECT_EQ(driver.status().detail.view(),
            pipe.string() + ": is no regular file; name a recording");
}

TEST(ReplayDriver, LoopOverFileWithoutSamples_IsFaultyAndSaysSo) {
  const test::TemporaryFolder folder;
  std::ofstream(folder.path() / "empty.bin").flush();
  ReplayDriver driver({folder.path() / "empty.bin", 0, true, {}});
  PlayedSamples sink;
  driver.run({}, sink);
  EXPECT_EQ(driver.status().state, LidarState::kFaulty);
  EXPECT_NE(driver.status().detail.view().find("empty.bin: no sample in it"), std::string::npos);
}

}  // namespace
}  // namespace cornerd::replay
