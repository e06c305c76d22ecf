// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "drivers/config/motor_config.hpp"
#include "drivers/stream/stream_driver.hpp"
#include "drivers/ydlidar/ydlidar_decoder.hpp"

namespace cornerd::ydlidar {

/// X4: takes requests (A5 60 start, A5 65 stop, A5 90 information, A5 91 or 92 health), whose
/// answers have the RPLidar's form. X2: sends as soon as it has power. The USB adapters of both
/// switch the motor by DTR, asserted: on.
class YdlidarProtocol : public drivers::StreamProtocol {
 public:
  /// `motor_by_dtr`: false leaves DTR alone.
  explicit YdlidarProtocol(bool motor_by_dtr) : motor_by_dtr_(motor_by_dtr) {}

  std::string_view name() const override { return "a YDLIDAR"; }
  std::optional<Device> start(drivers::ByteStream& port, drivers::Clock& clock,
                              const std::stop_token& stop) override;
  void stop(drivers::ByteStream& port) override;
  std::unique_ptr<drivers::FrameDecoder> make_decoder() const override {
    return std::make_unique<YdlidarDecoder>();
  }

 private:
  bool motor_by_dtr_;
};

}  // namespace cornerd::ydlidar
