// SPDX-License-Identifier: MIT
#pragma once

#include "drivers/ld/ld_decoder.hpp"
#include "drivers/stream/stream_driver.hpp"

namespace cornerd::ld {

/// LD06, LD19, STL-19P, STL-27L: they send as soon as they have power, and take no requests.
class LdProtocol : public drivers::StreamProtocol {
 public:
  std::string_view name() const override { return "an LD lidar"; }
  std::optional<Device> start(drivers::ByteStream& /*port*/, drivers::Clock& /*clock*/,
                              const std::stop_token& /*stop*/) override {
    return Device{.model = "LDROBOT", .firmware = {}, .serial = {}, .health = {}};
  }
  void stop(drivers::ByteStream& /*port*/) override {}
  std::unique_ptr<drivers::FrameDecoder> make_decoder() const override {
    return std::make_unique<LdDecoder>();
  }
};

}  // namespace cornerd::ld
