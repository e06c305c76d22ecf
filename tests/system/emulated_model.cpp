// SPDX-License-Identifier: MIT
#include "emulated_model.hpp"

#include <algorithm>
#include <utility>
#include <vector>

#include "replay/emulator/make_emulator.hpp"
#include "replay/simulator/random.hpp"
#include "settings/map_file.hpp"

namespace cornerd::system_test {
namespace {

constexpr std::uint64_t kWhole = 600;
constexpr std::uint64_t kKept = 580;

/// A device on a line with faults.
class FaultyDevice : public replay::DeviceEmulator {
 public:
  FaultyDevice(std::unique_ptr<replay::DeviceEmulator> device, std::atomic<LineFault>& fault)
      : device_(std::move(device)), fault_(fault) {}

  void receive(std::span<const std::uint8_t> bytes, core::TimeNs now_ns) override {
    device_->receive(bytes, now_ns);
  }
  void take(core::TimeNs now_ns, std::vector<std::uint8_t>& out) override {
    const LineFault fault = fault_.load();
    device_->set_stalled(fault == LineFault::kSilence, now_ns);
    sent_.clear();
    device_->take(now_ns, sent_);
    for (const std::uint8_t byte : sent_) {
      const bool is_kept = count_++ % kWhole < kKept;
      if (fault == LineFault::kHalfFrames && !is_kept) continue;
      out.push_back(
          fault == LineFault::kGarbage ? static_cast<std::uint8_t>(random_.uniform(0, 256)) : byte);
    }
  }
  std::optional<core::TimeNs> next_ns() const override { return device_->next_ns(); }
  void set_stalled(bool stalled, core::TimeNs now_ns) override {
    device_->set_stalled(stalled, now_ns);
  }

 private:
  std::unique_ptr<replay::DeviceEmulator> device_;
  std::atomic<LineFault>& fault_;
  std::vector<std::uint8_t> sent_;
  std::uint64_t count_ = 0;
  replay::Random random_{1};
};

}  // namespace

EmulatedModel::EmulatedModel(std::string_view model, const std::filesystem::path& map,
                             const replay::Motion& motion, const std::filesystem::path& link)
    : motion_(motion) {
  const drivers::LidarModel& row = *drivers::find_lidar_model(model);
  auto scene = std::make_unique<replay::CoverableScene>(
      std::make_unique<replay::MapScene>(settings::load_map(map), motion));
  scene_ = scene.get();
  pty_ = std::make_unique<replay::PtyEmulator>(
      std::make_unique<FaultyDevice>(
          replay::make_emulator(row, std::move(scene), replay::simulator_of(row)), fault_),
      link);
  pty_->expect_speed(row.baud);
  pty_->set_on_time(
      [this](core::TimeNs t_ns, core::TimeNs unix_ns) { start_unix_ns_.store(unix_ns - t_ns); });
  thread_ = std::jthread([this](const std::stop_token& stop) { pty_->run(stop); });
}

EmulatedModel::~EmulatedModel() {
  thread_ = {};
  pty_.reset();
}

std::optional<core::Pose2> EmulatedModel::true_pose(double unix_s) const {
  const core::TimeNs start_ns = start_unix_ns_.load();
  if (start_ns == 0) return std::nullopt;
  const core::TimeNs t_ns =
      static_cast<core::TimeNs>((unix_s - static_cast<double>(start_ns / 1'000'000'000)) * 1e9) -
      start_ns % 1'000'000'000;
  return motion_(t_ns, 0);
}

}  // namespace cornerd::system_test
