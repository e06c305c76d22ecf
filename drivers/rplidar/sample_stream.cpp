// SPDX-License-Identifier: MIT
#include "drivers/rplidar/sample_stream.hpp"

#include <array>
#include <cstddef>
#include <memory>

#include "drivers/rplidar/wire/capsule.hpp"
#include "drivers/rplidar/wire/standard_node.hpp"

namespace cornerd::rplidar {
namespace {

constexpr double nominal_period_s(WireFormat format) {
  switch (format) {
    case WireFormat::kStandard:
      return 508e-6;
    case WireFormat::kExpress:
      return 254e-6;
    case WireFormat::kUltra:
      return 127e-6;
    case WireFormat::kDense:
      return 200e-6;  // C1; S1 108, S2 and S3 31.25
    case WireFormat::kUltraDense:
      return 31.25e-6;
    case WireFormat::kHq:
      return 100e-6;
  }
  return 508e-6;
}

constexpr drivers::FrameTiming timing_of(WireFormat format) {
  const double period_s = nominal_period_s(format);
  if (format == WireFormat::kStandard) return {period_s, kNodeSize, 1};
  return {period_s, capsule_size(format), 2 * capsule_samples(format) - 1};
}

/// By format: asked for each sample.
constexpr std::array kTimings = {
    timing_of(WireFormat::kStandard),   timing_of(WireFormat::kExpress),
    timing_of(WireFormat::kUltra),      timing_of(WireFormat::kDense),
    timing_of(WireFormat::kUltraDense), timing_of(WireFormat::kHq)};

float radians_of(std::uint16_t angle_q6) {
  constexpr float kRadian = 3.14159265358979F / 180 / 64;
  const int angle = angle_q6 <= kFullRevolutionQ6 / 2 ? angle_q6 : angle_q6 - kFullRevolutionQ6;
  return static_cast<float>(angle) * kRadian;
}

}  // namespace

void RplidarFrames::feed(std::span<const std::uint8_t> bytes, drivers::FrameSink& sink) {
  sink_ = &sink;
  decoder_.feed(bytes, *this);
}

void RplidarFrames::finish(drivers::FrameSink& sink) {
  sink_ = &sink;
  decoder_.finish(*this);
}

drivers::FrameTiming RplidarFrames::timing() const {
  return kTimings[static_cast<std::size_t>(decoder_.format().value_or(WireFormat::kStandard))];
}

void RplidarFrames::on_sample(const RawSample& raw) {
  sink_->on_sample({.index = raw.index,
                    .device_rad = radians_of(raw.angle_q6),
                    .range_m = static_cast<float>(raw.dist_q2) / 4000,
                    .quality = raw.quality,
                    .starts_scan = raw.starts_scan});
}

SampleStream::SampleStream(RplidarFrames* frames, const SampleStreamConfig& config)
    : drivers::SampleStream(std::unique_ptr<drivers::FrameDecoder>(frames),
                            {config.inverted, config.sample_period_s, config.baud}),
      frames_(frames) {}

}  // namespace cornerd::rplidar
