// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <stop_token>
#include <string>
#include <string_view>
#include <vector>

#include "drivers/driver_clock.hpp"
#include "drivers/lidar_driver.hpp"
#include "drivers/serial/byte_stream.hpp"
#include "drivers/serial/serial_port.hpp"
#include "drivers/stream/baud_search.hpp"
#include "drivers/stream/frame_decoder.hpp"
#include "drivers/stream/status_board.hpp"

namespace cornerd::drivers {

struct StreamDriverConfig {
  std::string device = "/dev/ttyUSB0";
  std::vector<std::uint32_t> baud_rates;  ///< tried in this order until one gives samples
  bool inverted = false;                  ///< mounted upside down
};

/// What differs between lidars that send one kind of packet. Used by the driver's thread alone.
class StreamProtocol {
 public:
  struct Device {
    std::string model;
    std::string firmware;
    std::string serial;
    std::string health;
    bool failed = false;               ///< its health says so
    double sample_period_s = 0;        ///< 0: the decoder's
    std::uint64_t received_bytes = 0;  ///< before the stream
    std::uint64_t used_bytes = 0;      ///< of them: answers
  };

  virtual ~StreamProtocol() = default;
  /// As in "an LD lidar".
  virtual std::string_view name() const = 0;
  /// Identifies and starts the device on an open port; nullopt: it does not answer. A device that
  /// sends by itself is only named.
  virtual std::optional<Device> start(ByteStream& port, Clock& clock,
                                      const std::stop_token& stop) = 0;
  virtual void stop(ByteStream& port) = 0;
  virtual std::unique_ptr<FrameDecoder> make_decoder() const = 0;
};

/// A lidar on a serial port that sends packets until it is stopped. Retries after every failure.
class StreamDriver : public LidarDriver {
 public:
  using PortOpener = std::function<OpenResult(std::uint32_t baud)>;

  /// `open_port`: replaces the config's device, for tests and recorders.
  StreamDriver(StreamDriverConfig config, std::unique_ptr<StreamProtocol> protocol,
               PortOpener open_port = nullptr, Clock& clock = system_clock());

  void run(std::stop_token stop, SampleSink& sink) override;
  LidarStatus status() override { return board_.read(); }
  bool take_change(LidarChange& change) override { return board_.take_change(change); }

 private:
  /// Why a session ended, and the driver's state until the next one.
  struct Failure {
    LidarState state = LidarState::kBackoff;
    LidarFault fault = LidarFault::kUnplugged;
    std::string extra = {};  ///< see hint()
  };
  struct Session;

  Failure session(ByteStream& opened, const std::stop_token& stop, SampleSink& sink);
  Failure measure(ByteStream& port, const StreamProtocol::Device& device,
                  const std::stop_token& stop, SampleSink& sink);
  std::optional<Failure> judge(Session& session, core::TimeNs now_ns, bool received, bool measured);
  /// Of a lidar that never measured and was never asked for its name, for a hint.
  std::string suspicions(bool has_received) const;
  /// The lidar as a hint names it.
  std::string described() const;
  void wait(std::chrono::milliseconds duration, const std::stop_token& stop);
  void report(LidarState state, LidarFault fault, std::string_view extra = {});

  StreamDriverConfig config_;
  BaudSearch rates_;
  std::unique_ptr<StreamProtocol> protocol_;
  PortOpener open_port_;
  Clock& clock_;
  StatusBoard board_;
  bool has_run_ = false;       ///< the last session delivered samples
  bool has_answered_ = false;  ///< the device of the last session, to a request
};

}  // namespace cornerd::drivers
