// SPDX-License-Identifier: MIT
#include "drivers/rplidar/decoder.hpp"

#include <array>
#include <cstddef>

#include "drivers/rplidar/wire/byte_window.hpp"
#include "drivers/rplidar/wire/capsule_decoder.hpp"
#include "drivers/rplidar/wire/standard_decoder.hpp"
#include "drivers/rplidar/wire/standard_node.hpp"

namespace cornerd::rplidar {
namespace {

// After this many undecodable bytes the format is wrong: a damaged descriptor, or the caller's
// error.
constexpr std::size_t kForgetFormatAfter = 4096;

// The shortest first: each waits for its packet's size.
constexpr std::array kSearchOrder = {WireFormat::kExpress,  WireFormat::kDense,
                                     WireFormat::kUltra,    WireFormat::kUltraDense,
                                     WireFormat::kStandard, WireFormat::kHq};

}  // namespace

/// Locked: the format's decoder takes packet after packet. Searching: byte after byte is skipped
/// until a packet is found.
class Decoder::Implementation {
 public:
  explicit Implementation(std::optional<WireFormat> format)
      : format_(format), last_format_(format.value_or(WireFormat::kExpress)) {}

  void feed(std::span<const std::uint8_t> bytes, RawSampleSink& sink) {
    counters_.bytes += bytes.size();
    while (!bytes.empty()) {
      bytes = bytes.subspan(window_.append(bytes));
      while (step(false, sink)) {
      }
    }
  }

  void finish(RawSampleSink& sink) {
    while (step(true, sink)) {
    }
    counters_.skipped_bytes += window_.unread().size();
    window_.consume(window_.unread().size());
    capsules_.drop_pending(index_);
    state_ = State::kSearching;
    has_history_ = false;
  }

  std::optional<WireFormat> format() const { return format_; }
  const drivers::StreamCounters& counters() const { return counters_; }

 private:
  enum class State : std::uint8_t { kSearching, kLocked };

  /// True if bytes were consumed.
  bool step(bool final, RawSampleSink& sink) {
    if (state_ != State::kLocked) return search(final, sink);
    const Step result = *format_ == WireFormat::kStandard
                            ? standard_.step(window_, index_, final, sink)
                            : capsules_.step(window_, index_, sink);
    if (result != Step::kLost) return result == Step::kProgress;
    state_ = State::kSearching;
    skipped_since_lock_ = 0;
    return true;
  }

  bool search(bool final, RawSampleSink& sink) {
    const auto bytes = window_.unread();
    if (bytes.empty()) return false;
    const DescriptorMatch descriptor = match_scan_descriptor(bytes);
    if (descriptor.verdict == Verdict::kMore && !final) return false;
    if (descriptor.verdict == Verdict::kYes) {
      window_.consume(kDescriptorSize);
      counters_.used_bytes += kDescriptorSize;
      begin_stream(descriptor.format, sink);
      return true;
    }
    for (const WireFormat format : kSearchOrder) {
      if (!may_be(format)) continue;
      const Verdict verdict = match_packet(format, bytes, final);
      if (verdict == Verdict::kMore) return false;
      if (verdict == Verdict::kNo) continue;
      lock_again(format, sink);
      return true;
    }
    window_.consume(1);
    ++counters_.skipped_bytes;
    if (++skipped_since_lock_ == kForgetFormatAfter) format_.reset();
    return true;
  }

  /// Express and dense capsules differ in nothing that a decoder could see, and an HQ packet takes
  /// long to be told: of an unknown format both are only what the last one was.
  bool may_be(WireFormat format) const {
    if (format_) return format_ == format;
    if (format == WireFormat::kExpress) return last_format_ != WireFormat::kDense;
    const bool is_told = format == WireFormat::kDense || format == WireFormat::kHq;
    return !is_told || last_format_ == format;
  }

  static Verdict match_packet(WireFormat format, std::span<const std::uint8_t> bytes, bool final) {
    return format == WireFormat::kStandard ? match_node_chain(bytes, nullptr, 1, final).verdict
                                           : match_capsule(bytes, format, final);
  }

  void begin_stream(WireFormat format, RawSampleSink& sink) {
    capsules_.drop_pending(index_);
    if (counters_.samples > 0) sink.on_gap();
    lock(format, false);
  }

  void lock_again(WireFormat format, RawSampleSink& sink) {
    const bool same_stream = has_history_ && format_ == format;
    const std::size_t packet = format == WireFormat::kStandard ? kNodeSize : capsule_size(format);
    if (same_stream && skipped_since_lock_ % packet != 0) ++counters_.resyncs;
    // A short gap has a known length in capsules, by their angles, but not in nodes.
    const bool knows_length = same_stream && format != WireFormat::kStandard;
    if (!knows_length && counters_.samples > 0) sink.on_gap();
    lock(format, same_stream);
  }

  void lock(WireFormat format, bool same_stream) {
    format_ = last_format_ = format;
    state_ = State::kLocked;
    has_history_ = true;
    skipped_since_lock_ = 0;
    if (format == WireFormat::kStandard) {
      standard_.lock();
    } else {
      capsules_.lock(format, same_stream);
    }
  }

  std::optional<WireFormat> format_;
  WireFormat last_format_;  ///< of the stream, or as the caller said
  State state_ = State::kSearching;
  drivers::StreamCounters counters_;
  ByteWindow window_;
  std::uint64_t index_ = 0;
  std::size_t skipped_since_lock_ = 0;
  bool has_history_ = false;  ///< packets of `format_` have been decoded in this stream
  StandardDecoder standard_{counters_};
  CapsuleDecoder capsules_{counters_};
};

Decoder::Decoder(std::optional<WireFormat> format)
    : implementation_(std::make_unique<Implementation>(format)) {}
Decoder::~Decoder() = default;
Decoder::Decoder(Decoder&&) noexcept = default;
Decoder& Decoder::operator=(Decoder&&) noexcept = default;

void Decoder::feed(std::span<const std::uint8_t> bytes, RawSampleSink& sink) {
  implementation_->feed(bytes, sink);
}
void Decoder::finish(RawSampleSink& sink) { implementation_->finish(sink); }
std::optional<WireFormat> Decoder::format() const { return implementation_->format(); }
const drivers::StreamCounters& Decoder::counters() const { return implementation_->counters(); }

}  // namespace cornerd::rplidar
