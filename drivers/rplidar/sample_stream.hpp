// SPDX-License-Identifier: MIT
// The RPLidar's decoder, for any stream of samples.
#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "drivers/rplidar/decoder.hpp"
#include "drivers/stream/sample_stream.hpp"

namespace cornerd::rplidar {

/// Samples of the wire in metres and radians.
class RplidarFrames : public drivers::FrameDecoder, private RawSampleSink {
 public:
  /// `format`: of a stream without a descriptor; nullopt: detect.
  explicit RplidarFrames(std::optional<WireFormat> format = std::nullopt) : decoder_(format) {}

  void feed(std::span<const std::uint8_t> bytes, drivers::FrameSink& sink) override;
  void finish(drivers::FrameSink& sink) override;
  drivers::FrameTiming timing() const override;
  const drivers::StreamCounters& counters() const override { return decoder_.counters(); }
  std::optional<WireFormat> format() const { return decoder_.format(); }

 private:
  void on_sample(const RawSample& raw) override;
  void on_gap() override { sink_->on_gap(); }

  Decoder decoder_;
  drivers::FrameSink* sink_ = nullptr;
};

struct SampleStreamConfig {
  std::optional<WireFormat> format;  ///< of a stream without a descriptor; nullopt: detect
  bool inverted = false;             ///< mounted upside down: bearing = +angle instead of -angle
  double sample_period_s = 0;  ///< as the device reports; implausible: the format's nominal one
  std::uint32_t baud = 115200;
};

/// An RPLidar's bytes to timed samples.
class SampleStream : public drivers::SampleStream {
 public:
  explicit SampleStream(const SampleStreamConfig& config)
      : SampleStream(new RplidarFrames(config.format), config) {}

  std::optional<WireFormat> format() const { return frames_->format(); }

 private:
  /// Owns `frames`.
  SampleStream(RplidarFrames* frames, const SampleStreamConfig& config);

  const RplidarFrames* frames_;  ///< of the base
};

}  // namespace cornerd::rplidar
