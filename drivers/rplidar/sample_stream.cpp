// SPDX-License-Identifier: MIT
#include "drivers/rplidar/sample_stream.hpp"

#include <algorithm>
#include <cstddef>
#include <vector>

#include "drivers/rplidar/sample_clock.hpp"
#include "drivers/rplidar/wire/capsule.hpp"

namespace cornerd::rplidar {
namespace {

// Earlier bytes of a buffer arrived earlier, by the speed of the wire. Each piece of this size gets
// its own arrival time.
constexpr std::size_t kPieceBytes = 8;
constexpr int kBitsPerByte = 10;  // 8N1

// Samples held for their time: a second of the fastest mode.
constexpr std::size_t kMaxHeld = 8192;

// From the middle of a measurement to the first bit of its packet: half a period of measuring, one
// of computing, as the vendor's SDK assumes.
constexpr double kPeriodsToSend = 1.5;

double nominal_period_s(WireFormat format) {
  switch (format) {
    case WireFormat::kStandard:
      return 508e-6;
    case WireFormat::kExpress:
      return 254e-6;
    case WireFormat::kUltra:
      return 127e-6;
  }
  return 508e-6;
}

/// A reported period beyond this ratio is damaged; the clock would not recover from it.
constexpr double kMaxPeriodRatio = 5;

/// A packet's size, and how far its newest sample is ahead of the first one delivered.
struct Packet {
  std::size_t bytes;
  std::size_t samples_ahead;
};

Packet packet_of(WireFormat format) {
  if (format == WireFormat::kStandard) return {kNodeSize, 1};
  return {capsule_size(format), 2 * capsule_samples(format) - 1};
}

float bearing_of(std::uint16_t angle_q6, bool inverted) {
  constexpr float kRadian = 3.14159265358979F / 180 / 64;
  constexpr float kLargest = 3.1415925F;  // the last float below pi
  const int angle = angle_q6 <= kFullRevolutionQ6 / 2 ? angle_q6 : angle_q6 - kFullRevolutionQ6;
  const float bearing = static_cast<float>(inverted ? angle : -angle) * kRadian;
  return std::clamp(bearing, -kLargest, kLargest);
}

}  // namespace

class SampleStream::Implementation : private RawSampleSink {
 public:
  explicit Implementation(const SampleStreamConfig& config)
      : config_(config), decoder_(config.format), clock_(period_s(WireFormat::kStandard)) {
    held_.reserve(kMaxHeld);
  }

  void feed(std::span<const std::uint8_t> bytes, core::TimeNs arrival_ns, drivers::SampleSink& sink,
            bool more_pending) {
    sink_ = &sink;
    more_pending_ = more_pending;
    first_of_feed_ = true;
    const double byte_ns = 1e9 * kBitsPerByte / config_.baud;
    while (!bytes.empty()) {
      const auto piece = bytes.first(std::min(kPieceBytes, bytes.size()));
      bytes = bytes.subspan(piece.size());
      piece_arrival_ns_ =
          arrival_ns - static_cast<core::TimeNs>(byte_ns * static_cast<double>(bytes.size()));
      first_of_piece_ = true;
      decoder_.feed(piece, *this);
    }
    first_of_piece_ = false;
  }

  void feed_untimed(std::span<const std::uint8_t> bytes, drivers::SampleSink& sink) {
    sink_ = &sink;
    timed_ = false;
    decoder_.feed(bytes, *this);
  }

  void finish(drivers::SampleSink& sink) {
    sink_ = &sink;
    decoder_.finish(*this);
  }

  std::optional<WireFormat> format() const { return decoder_.format(); }

  std::uint64_t samples() const { return samples_; }

  const core::LatencyHistogram& latency() const { return latency_; }

  const drivers::StreamCounters& counters() {
    counters_ = decoder_.counters();
    counters_.clock_resets = clock_.resets();
    counters_.untimed_samples = dropped_ + held_.size();
    return counters_;
  }

 private:
  void on_sample(const RawSample& raw) override {
    ++samples_;
    const std::uint64_t resets = clock_.resets();
    const WireFormat format = *decoder_.format();
    if (format != clock_format_) {
      clock_format_ = format;
      drop_held();
      clock_.reset(period_s(format));
    }
    if (timed_) observe(raw, format);
    if (clock_.is_uncertain()) return hold(raw);
    // The number of lost samples is unknown, and two halves make no scan.
    if (clock_.resets() != resets || has_gap_) sink_->on_gap();
    release(clock_.resets() != resets);
    deliver(raw);
  }

  void hold(const RawSample& raw) {
    if (held_.size() == kMaxHeld) drop_held();
    held_.push_back(raw);
  }

  /// Samples read before the end of a pause have unknown times.
  void release(bool after_pause) {
    for (const RawSample& held : held_) {
      if (!after_pause || held.index >= clock_.anchored_from()) {
        deliver(held);
      } else {
        ++dropped_;
      }
    }
    held_.clear();
    has_gap_ = false;
  }

  void drop_held() {
    has_gap_ = has_gap_ || !held_.empty();
    dropped_ += held_.size();
    held_.clear();
  }

  void deliver(const RawSample& raw) {
    const core::TimeNs t_ns =
        timed_ ? clock_.time_of(raw.index)
               : core::from_seconds(static_cast<double>(raw.index) * period_s(*decoder_.format()));
    sink_->on_sample({.t_ns = t_ns,
                      .bearing_rad = bearing_of(raw.angle_q6, config_.inverted),
                      .range_m = static_cast<float>(raw.dist_q2) / 4000,
                      .quality = raw.quality,
                      .starts_scan = raw.starts_scan});
  }

  void on_gap() override {
    drop_held();
    clock_.reanchor();
    sink_->on_gap();
  }

  void observe(const RawSample& raw, WireFormat format) {
    if (!first_of_piece_ && clock_.anchored()) return;
    const Packet packet = packet_of(format);
    const double byte_ns = 1e9 * kBitsPerByte / config_.baud;
    const double sent_ns =
        byte_ns * static_cast<double>(packet.bytes) + kPeriodsToSend * clock_.period_s() * 1e9;
    clock_.observe(raw.index + packet.samples_ahead,
                   piece_arrival_ns_ - static_cast<core::TimeNs>(sent_ns), more_pending_);
    first_of_piece_ = false;
    if (first_of_feed_) latency_.add(clock_.last_delay_ns());
    first_of_feed_ = false;
  }

  double period_s(WireFormat format) const {
    const double nominal_s = nominal_period_s(format);
    const bool is_plausible = config_.sample_period_s > nominal_s / kMaxPeriodRatio &&
                              config_.sample_period_s < nominal_s * kMaxPeriodRatio;
    return is_plausible ? config_.sample_period_s : nominal_s;
  }

  SampleStreamConfig config_;
  Decoder decoder_;
  SampleClock clock_;
  std::optional<WireFormat> clock_format_;
  drivers::SampleSink* sink_ = nullptr;
  core::TimeNs piece_arrival_ns_ = 0;
  bool more_pending_ = false;
  bool first_of_piece_ = false;
  bool first_of_feed_ = false;
  core::LatencyHistogram latency_;
  bool timed_ = true;
  std::uint64_t samples_ = 0;
  std::vector<RawSample> held_;  ///< their time is uncertain
  std::uint64_t dropped_ = 0;    ///< of held_
  bool has_gap_ = false;         ///< samples were dropped since the last delivered one
  drivers::StreamCounters counters_;
};

SampleStream::SampleStream(const SampleStreamConfig& config)
    : implementation_(std::make_unique<Implementation>(config)) {}
SampleStream::~SampleStream() = default;
SampleStream::SampleStream(SampleStream&&) noexcept = default;
SampleStream& SampleStream::operator=(SampleStream&&) noexcept = default;

void SampleStream::feed(std::span<const std::uint8_t> bytes, core::TimeNs arrival_ns,
                        drivers::SampleSink& sink, bool more_pending) {
  implementation_->feed(bytes, arrival_ns, sink, more_pending);
}
void SampleStream::feed_untimed(std::span<const std::uint8_t> bytes, drivers::SampleSink& sink) {
  implementation_->feed_untimed(bytes, sink);
}
void SampleStream::finish(drivers::SampleSink& sink) { implementation_->finish(sink); }
std::optional<WireFormat> SampleStream::format() const { return implementation_->format(); }
std::uint64_t SampleStream::samples() const { return implementation_->samples(); }
const drivers::StreamCounters& SampleStream::counters() const {
  return implementation_->counters();
}
const core::LatencyHistogram& SampleStream::latency() const { return implementation_->latency(); }

}  // namespace cornerd::rplidar
