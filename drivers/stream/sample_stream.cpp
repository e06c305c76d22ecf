// SPDX-License-Identifier: MIT
#include "drivers/stream/sample_stream.hpp"

#include <algorithm>
#include <cstddef>
#include <utility>

namespace cornerd::drivers {
namespace {

// Earlier bytes of a buffer arrived earlier, by the speed of the wire. Each piece of this size gets
// its own arrival time.
constexpr std::size_t kPieceBytes = 8;
constexpr int kBitsPerByte = 10;  // 8N1

// Samples held for their time: 0.3 s of the fastest lidar.
constexpr std::size_t kMaxHeld = 16384;

// From the middle of a measurement to the first bit of its packet: half a period of measuring, one
// of computing, as the RPLidar SDK assumes.
constexpr double kPeriodsToSend = 1.5;

/// A reported period beyond this ratio is damaged; the clock would not recover from it. An S2's
/// nodes have an eighth of an A1's.
constexpr double kMaxPeriodRatio = 10;

/// Until the decoder gives its own.
constexpr double kUnknownPeriodS = 508e-6;

}  // namespace

SampleStream::SampleStream(std::unique_ptr<FrameDecoder> decoder, const StreamConfig& config)
    : config_(config), decoder_(std::move(decoder)), clock_(period_s(kUnknownPeriodS)) {
  held_.reserve(kMaxHeld);
}

void SampleStream::feed(std::span<const std::uint8_t> bytes, core::TimeNs arrival_ns,
                        SampleSink& sink, bool more_pending) {
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
    decoder_->feed(piece, *this);
  }
  first_of_piece_ = false;
}

void SampleStream::feed_untimed(std::span<const std::uint8_t> bytes, SampleSink& sink) {
  sink_ = &sink;
  timed_ = false;
  decoder_->feed(bytes, *this);
}

void SampleStream::finish(SampleSink& sink) {
  sink_ = &sink;
  decoder_->finish(*this);
}

const StreamCounters& SampleStream::counters() const {
  counters_ = decoder_->counters();
  counters_.clock_resets = clock_.resets();
  counters_.untimed_samples = dropped_ + held_.size();
  return counters_;
}

void SampleStream::on_sample(const FrameSample& raw) {
  ++samples_;
  const std::uint64_t resets = clock_.resets();
  const FrameTiming timing = decoder_->timing();
  if (timing.period_s != nominal_period_s_) {
    nominal_period_s_ = timing.period_s;
    drop_held();
    clock_.reset(period_s(nominal_period_s_));
  }
  if (timed_) observe(raw, timing);
  if (clock_.is_uncertain()) return hold(raw);
  // The number of lost samples is unknown, and two halves make no scan.
  if (clock_.resets() != resets || has_gap_) sink_->on_gap();
  release(clock_.resets() != resets);
  deliver(raw);
}

void SampleStream::on_gap() {
  drop_held();
  clock_.reanchor();
  sink_->on_gap();
}

void SampleStream::hold(const FrameSample& raw) {
  if (held_.size() == kMaxHeld) drop_held();
  held_.push_back(raw);
}

/// Samples read before the end of a pause have unknown times.
void SampleStream::release(bool after_pause) {
  for (const FrameSample& held : held_) {
    if (!after_pause || held.index >= clock_.anchored_from()) {
      deliver(held);
    } else {
      ++dropped_;
    }
  }
  held_.clear();
  has_gap_ = false;
}

void SampleStream::drop_held() {
  has_gap_ = has_gap_ || !held_.empty();
  dropped_ += held_.size();
  held_.clear();
}

void SampleStream::deliver(const FrameSample& raw) {
  constexpr float kLargest = 3.1415925F;  // the last float below pi
  const float bearing = config_.inverted ? raw.device_rad : -raw.device_rad;
  const core::TimeNs t_ns =
      timed_ ? clock_.time_of(raw.index)
             : core::from_seconds(static_cast<double>(raw.index) * period_s(nominal_period_s_));
  if (timed_ && raw.starts_scan) sink_->on_arrival(packet_arrival_ns_);
  sink_->on_sample({.t_ns = t_ns,
                    .bearing_rad = std::clamp(bearing, -kLargest, kLargest),
                    .range_m = raw.range_m,
                    .quality = raw.quality,
                    .starts_scan = raw.starts_scan});
}

void SampleStream::observe(const FrameSample& raw, const FrameTiming& timing) {
  if (!first_of_piece_ && clock_.anchored()) return;
  const double byte_ns = 1e9 * kBitsPerByte / config_.baud;
  const double sent_ns =
      byte_ns * static_cast<double>(timing.packet_bytes) + kPeriodsToSend * clock_.period_s() * 1e9;
  clock_.observe(raw.index + timing.samples_ahead,
                 piece_arrival_ns_ - static_cast<core::TimeNs>(sent_ns), more_pending_);
  // What the read is late by, compared with the fastest ones: it waited for more bytes.
  packet_arrival_ns_ = piece_arrival_ns_ - clock_.last_delay_ns();
  first_of_piece_ = false;
  if (first_of_feed_) latency_.add(clock_.last_delay_ns());
  first_of_feed_ = false;
}

double SampleStream::period_s(double nominal_s) const {
  const bool is_plausible = config_.sample_period_s > nominal_s / kMaxPeriodRatio &&
                            config_.sample_period_s < nominal_s * kMaxPeriodRatio;
  return is_plausible ? config_.sample_period_s : nominal_s;
}

}  // namespace cornerd::drivers
