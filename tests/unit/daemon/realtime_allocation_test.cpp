// SPDX-License-Identifier: MIT
// Reader and localizer over 10,000 scans: no heap allocation and no page fault after the warm-up.
#include <gtest/gtest.h>
#include <poll.h>

#include <algorithm>
#include <atomic>
#include <cstdlib>
#include <memory>
#include <new>
#include <thread>
#include <vector>

#include "core/pipeline.hpp"
#include "daemon/localization.hpp"
#include "daemon/realtime.hpp"
#include "drivers/rplidar/protocol/answers.hpp"
#include "drivers/rplidar/protocol/framing.hpp"
#include "drivers/rplidar/rplidar_driver.hpp"
#include "replay/emulator/virtual_clock.hpp"
#include "replay/simulator/motion.hpp"
#include "replay/simulator/simulator.hpp"
#include "settings/map_file.hpp"
#include "tests/sanitized.hpp"

namespace {

std::atomic<std::size_t> allocations_of_loops{0};
thread_local bool is_excused = false;

}  // namespace

void* operator new(std::size_t size) {
  if (!is_excused) allocations_of_loops.fetch_add(1, std::memory_order_relaxed);
  void* memory = std::malloc(size);
  if (memory == nullptr) throw std::bad_alloc();
  return memory;
}
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }

namespace cornerd::daemon {
namespace {

#ifdef __arm__
constexpr std::uint64_t kScans = 200;  // in an emulator
#else
constexpr std::uint64_t kScans = test::kSanitized ? 200 : 10'000;
#endif
constexpr std::uint64_t kWarmUpScans = 100;

/// One express capsule per read; at the end no more data, and time stops.
class Wire : public drivers::ByteStream {
 public:
  Wire(const std::vector<std::uint8_t>& capsules, replay::VirtualClock& clock)
      : capsules_(capsules), clock_(clock) {}

  ReadResult read(std::span<std::uint8_t> buffer, std::chrono::milliseconds timeout) override {
    if (!answer_.empty()) {
      const std::size_t count = answer_.size();
      std::copy(answer_.begin(), answer_.end(), buffer.begin());
      answer_.clear();
      return {ReadStatus::kData, count};
    }
    if (!streams_) {
      clock_.wait(timeout, {});
      return {};
    }
    if (next_ == capsules_.size()) {
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
      return {};
    }
    clock_.advance_to(clock_.monotonic_ns() + 32 * 254'000);
    std::copy_n(capsules_.begin() + static_cast<std::ptrdiff_t>(next_), 84, buffer.begin());
    next_ += 84;
    return {ReadStatus::kData, 84};
  }

  bool write(std::span<const std::uint8_t> bytes) override {
    using rplidar::Command;
    for (const std::uint8_t byte : bytes) {
      const auto request = parser_.add(byte);
      if (!request) continue;
      if (request->command() == Command::kGetInfo) {
        answer(0x04, rplidar::DeviceInfo{0x18, rplidar::firmware_version(1, 17), 0, {}}.encode());
      } else if (request->command() == Command::kGetHealth) {
        answer(0x06, rplidar::Health{}.encode());
      } else if (request->command() == Command::kGetSampleRate) {
        answer(0x15, rplidar::SampleRate{508, 254}.encode());
      }
      streams_ = request->command() == Command::kExpressScan;
    }
    return true;
  }
  void discard_input() override {}
  bool set_dtr(bool /*asserted*/) override { return true; }

 private:
  void answer(std::uint8_t type, const auto& payload) {
    const auto head =
        rplidar::Descriptor{static_cast<std::uint32_t>(payload.size()), false, type}.encode();
    answer_.assign(head.begin(), head.end());
    answer_.insert(answer_.end(), payload.begin(), payload.end());
  }

  const std::vector<std::uint8_t>& capsules_;
  replay::VirtualClock& clock_;
  rplidar::RequestParser parser_;
  std::vector<std::uint8_t> answer_;
  bool streams_ = false;
  std::size_t next_ = 0;
};

std::vector<std::uint8_t> capsules_of(std::shared_ptr<const core::WallMap> map,
                                      std::uint64_t scans) {
  const auto motion =
      replay::drive_path({{0.36, 1.1}, {0.36, 0.24}, {0.95, 0.24}, {0.95, 1.15}, {0.95, 0.24}},
                         {.speed_m_s = 0.2, .loop = true});
  replay::Simulator simulator(std::make_unique<replay::MapScene>(map, motion), {});
  simulator.start(0, rplidar::WireFormat::kExpress, 254'000);
  std::vector<std::uint8_t> bytes;
  for (std::uint64_t scan = 0; scan < scans;) {
    const replay::WirePacket packet = simulator.next();
    bytes.insert(bytes.end(), packet.bytes.begin(), packet.bytes.end());
    for (const auto& sample : packet.samples) scan += sample.starts_scan ? 1 : 0;
  }
  return bytes;
}

#ifdef CORNERD_TESTS_EMULATED
constexpr bool kEmulated = true;  // the counts would include the emulator's page faults
#else
constexpr bool kEmulated = false;
#endif

TEST(Realtime, ReaderAndLocalizer_AfterWarmUp_NoAllocationsOrFaults) {
  is_excused = true;
  const auto map = settings::load_map(CORNERD_SOURCE_DIR "/config/maps/krpai-2019-a.json");
  const auto capsules = capsules_of(map, kScans + 10);
  replay::VirtualClock clock;
  rplidar::RplidarDriver driver(
      {.device = "wire", .motor = {}},
      [&](std::uint32_t /*baud*/) -> drivers::OpenResult {
        return {std::make_unique<Wire>(capsules, clock), drivers::OpenError::kNone, {}};
      },
      clock);
  Localization localization(driver, std::make_unique<core::Pipeline>(map, core::LocalizerConfig{}),
                            SourceKind::kRecording);
  localization.start();
  // A sanitizer maps more memory than the machine has.
  const bool is_touched = !test::kSanitized && prefault_memory();
  std::uint64_t scans = 0;
  std::uint64_t reported = 0;
  std::size_t allocations = 0;
  std::uint64_t faults = 0;
  const auto faults_so_far = [&] {
    return localization.localizer_health().page_faults + localization.reader_page_faults();
  };
  pollfd readable{localization.event_fd(), POLLIN, 0};
  while (scans < kScans && ::poll(&readable, 1, 60'000) == 1) {
    localization.take([&](const ScanReport&) { ++reported; }, [](const core::PoseEstimate&) {});
    scans = reported + localization.lost_reports();
    if (allocations == 0 && scans >= kWarmUpScans) {
      allocations = allocations_of_loops;
      faults = faults_so_far();
    }
  }
  EXPECT_EQ(allocations_of_loops - allocations, 0U) << "in " << kScans << " scans";
  if (!test::kSanitized && !kEmulated && is_touched) {
    EXPECT_EQ(faults_so_far() - faults, 0U) << "in " << kScans << " scans";
  }
  EXPECT_GE(scans, kScans);
}

}  // namespace
}  // namespace cornerd::daemon
