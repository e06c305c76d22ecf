// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <optional>
#include <utility>

#include "drivers/driver_clock.hpp"
#include "drivers/rplidar/device.hpp"
#include "drivers/rplidar/motor.hpp"
#include "drivers/rplidar/protocol/framing.hpp"
#include "drivers/serial/byte_stream.hpp"

namespace cornerd::rplidar {

/// Stops the device and its motor however a session ends.
class Shutdown {
 public:
  Shutdown(drivers::ByteStream& port, Motor& motor, std::optional<MotorRequest>& request,
           drivers::Clock& clock)
      : port_(port), motor_(motor), request_(request), clock_(clock) {}
  ~Shutdown() {
    const bool is_open = port_.write(Request(Command::kStop).bytes());
    if (const auto request = std::exchange(request_, std::nullopt); request && is_open) {
      clock_.wait(std::chrono::milliseconds(10), {});  // the protocol demands 1 ms
      port_.write(request->stop().bytes());
    }
    motor_.stop(port_);
  }
  Shutdown(const Shutdown&) = delete;
  Shutdown& operator=(const Shutdown&) = delete;

 private:
  drivers::ByteStream& port_;
  Motor& motor_;
  std::optional<MotorRequest>& request_;
  drivers::Clock& clock_;
};

}  // namespace cornerd::rplidar
