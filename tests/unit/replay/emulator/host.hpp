// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "drivers/rplidar/decoder.hpp"
#include "replay/emulator/emulator.hpp"
#include "replay/simulator/simulator.hpp"
#include "tests/unit/replay/hex.hpp"
#include "tests/unit/replay/test_maps.hpp"

namespace cornerd::replay {

constexpr core::TimeNs kMs = 1'000'000;

/// A host with its own clock.
class Host {
 public:
  explicit Host(const char* firmware, EmulatorConfig config = {})
      : emulator_(with_firmware(config, firmware),
                  std::make_unique<Simulator>(
                      std::make_unique<MapScene>(make_room(), stand_still({1, 1, 0})),
                      SimulatorConfig{})) {}

  void send(const std::string& hex) { emulator_.receive(from_hex(hex), now_ns_); }
  std::vector<std::uint8_t> receive_for(core::TimeNs duration_ns) {
    std::vector<std::uint8_t> bytes;
    const core::TimeNs end_ns = now_ns_ + duration_ns;
    while (now_ns_ < end_ns) {
      now_ns_ = std::min(now_ns_ + kMs, end_ns);
      emulator_.take(now_ns_, bytes);
    }
    return bytes;
  }
  /// The bytes within 20 ms of a request; any answer is faster.
  std::string ask(const std::string& hex) {
    send(hex);
    return to_hex(receive_for(20 * kMs));
  }
  /// The response descriptor of a scan request.
  std::string ask_for_scan(const std::string& hex) { return ask(hex).substr(0, 14); }

  Emulator& emulator() { return emulator_; }
  core::TimeNs now_ns() const { return now_ns_; }

 private:
  static EmulatorConfig with_firmware(EmulatorConfig config, const char* firmware) {
    config.firmware = find_firmware(firmware);
    return config;
  }

  Emulator emulator_;
  core::TimeNs now_ns_ = 0;
};

struct Samples : rplidar::RawSampleSink {
  void on_sample(const rplidar::RawSample& sample) override {
    ++count;
    valid += sample.dist_q2 != 0;
    scans += sample.starts_scan;
  }
  void on_gap() override { ++gaps; }
  int count = 0;
  int valid = 0;
  int scans = 0;
  int gaps = 0;
};

inline Samples decode(const std::vector<std::uint8_t>& bytes) {
  Samples samples;
  rplidar::Decoder decoder;
  decoder.feed(bytes, samples);
  return samples;
}

}  // namespace cornerd::replay
