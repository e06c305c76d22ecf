// SPDX-License-Identifier: MIT
#include "drivers/rplidar/wire/capsule_decoder.hpp"

#include <algorithm>

#include "drivers/rplidar/wire/express.hpp"
#include "drivers/rplidar/wire/ultra.hpp"

namespace cornerd::rplidar {
namespace {

constexpr std::uint8_t kUnknownQuality = 47;  // the format has none; the vendor's SDK says this

}  // namespace

void CapsuleDecoder::lock(WireFormat format, bool same_stream) {
  if (same_stream && format == format_) {
    followed_at_once_ = false;
    return;
  }
  format_ = format;
  has_waiting_ = false;
  followed_at_once_ = true;
  damaged_ = 0;
  scan_began_in_gap_ = false;
  cadence_.reset(format);
}

Step CapsuleDecoder::step(ByteWindow& window, std::uint64_t& index, RawSampleSink& sink) {
  const std::size_t size = capsule_size(format_);
  const auto bytes = window.unread();
  if (bytes.size() < 2) return Step::kMore;
  if (!has_capsule_sync(bytes)) return Step::kLost;
  if (bytes.size() < size) return Step::kMore;
  const auto capsule = bytes.first(size);
  if (!has_right_checksum(capsule)) {
    ++counters_->bad_checksums;
    ++damaged_;
    return Step::kLost;
  }
  pair(capsule, index, sink);
  window.consume(size);
  counters_->used_bytes += size;
  return Step::kProgress;
}

void CapsuleDecoder::pair(std::span<const std::uint8_t> next, std::uint64_t& index,
                          RawSampleSink& sink) {
  if (has_waiting_ && begins_stream(next)) {
    drop_waiting(index);
    sink.on_gap();
  } else if (has_waiting_) {
    const int start_q6 = start_angle_q6(waiting_);
    const int diff_q6 = (start_angle_q6(next) - start_q6 + kFullRevolutionQ6) % kFullRevolutionQ6;
    const auto [judgement, missing] = cadence_.judge(diff_q6, damaged_);
    if (judgement == CapsuleCadence::Judgement::kNeighbours && followed_at_once_) {
      decode_waiting(next, diff_q6, index, sink);
      index += capsule_samples(format_);
    } else {
      const int damaged = damaged_;
      const bool one_missing = judgement == CapsuleCadence::Judgement::kHole && missing == 1;
      if (one_missing) {
        // The head turned evenly over the two capsules: half the angle is the first one's.
        decode_waiting({}, diff_q6 / 2, index, sink);
        index += capsule_samples(format_);
        has_waiting_ = false;
      } else {
        drop_waiting(index);
      }
      const int hole_from_q6 = one_missing ? start_q6 + diff_q6 / 2 : start_q6;
      if (judgement == CapsuleCadence::Judgement::kUnknown) {
        counters_->lost_capsules += static_cast<std::uint64_t>(missing);
        sink.on_gap();
        scan_began_in_gap_ = false;
      } else {
        counters_->lost_capsules += static_cast<std::uint64_t>(std::max(0, missing - damaged));
        index += static_cast<std::uint64_t>(missing) * capsule_samples(format_);
        const bool wraps =
            hole_from_q6 < kFullRevolutionQ6 && start_q6 + diff_q6 >= kFullRevolutionQ6;
        scan_began_in_gap_ = scan_began_in_gap_ || wraps;
      }
    }
  }
  std::copy(next.begin(), next.end(), waiting_.begin());
  has_waiting_ = true;
  followed_at_once_ = true;
  damaged_ = 0;
}

void CapsuleDecoder::drop_waiting(std::uint64_t& index) {
  if (!has_waiting_) return;
  ++counters_->unpaired_capsules;
  index += capsule_samples(format_);
  has_waiting_ = false;
  damaged_ = 0;
}

void CapsuleDecoder::decode_waiting(std::span<const std::uint8_t> next, int diff_q6,
                                    std::uint64_t index, RawSampleSink& sink) {
  std::array<SweepSample, kUltraSamples> samples;
  const Sweep sweep{.start_q6 = start_angle_q6(waiting_), .diff_q6 = diff_q6};
  const std::span<const std::uint8_t, kUltraSize> capsule(waiting_);
  const std::span<SweepSample, kUltraSamples> decoded(samples);
  if (format_ == WireFormat::kExpress) {
    decode_express(capsule.first<kExpressSize>(), sweep, decoded.first<kExpressSamples>());
  } else {
    decode_ultra(capsule, next.empty() ? 0 : first_major(next), sweep, decoded);
    if (next.empty()) {
      // The last ranges are differences to the next capsule's first one.
      for (SweepSample& sample : decoded.last(2)) sample.dist_q2 = 0;
    }
  }
  for (const SweepSample& sample : decoded.first(capsule_samples(format_))) {
    const bool starts_scan = sample.starts_scan || scan_began_in_gap_;
    scan_began_in_gap_ = false;
    ++counters_->samples;
    if (starts_scan) ++counters_->scans;
    sink.on_sample({.index = index++,
                    .angle_q6 = sample.angle_q6,
                    .dist_q2 = sample.dist_q2,
                    .quality = sample.dist_q2 > 0 ? kUnknownQuality : std::uint8_t{0},
                    .starts_scan = starts_scan});
  }
}

}  // namespace cornerd::rplidar
