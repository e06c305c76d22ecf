// SPDX-License-Identifier: MIT
#include "drivers/rplidar/wire/capsule_decoder.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "drivers/rplidar/wire/capsule.hpp"
#include "drivers/rplidar/wire/standard_node.hpp"

namespace cornerd::rplidar {
namespace {

constexpr float kDegree = 64;
// The slowest capsule of a format at 11 Hz: 8.1 ms of express and dense, 12.2 ms of ultra. More is
// a gap while the speed is unknown.
constexpr float kFirstLimitShort = 33 * kDegree;
constexpr float kFirstLimitLong = 50 * kDegree;

constexpr float kMinRatio = 0.6F;
constexpr float kMaxRatio = 1.5F;
constexpr float kSpeedGain = 0.25F;

// A gap of a whole number of capsules, and well below a revolution, has a known length.
constexpr float kWholeTolerance = 0.35F;
constexpr int kMaxGapQ6 = kFullRevolutionQ6 / 2;

// This many equal steps in a row are a new speed; fewer while none is known, as for early heads,
// whose express capsules take 16 ms.
constexpr int kNewSpeed = 4;
constexpr int kFirstSpeed = 2;

}  // namespace

void CapsuleGapDetector::reset(WireFormat format) {
  step_q6_ = 0;
  const bool is_long = format == WireFormat::kUltra || format == WireFormat::kHq;
  first_limit_q6_ = is_long ? kFirstLimitLong : kFirstLimitShort;
  rejections_ = 0;
}

CapsuleGapDetector::Result CapsuleGapDetector::classify(int diff_q6, int damaged_between) {
  const auto diff = static_cast<float>(diff_q6);
  const bool known = step_q6_ > 0;
  const bool fits = known ? diff >= kMinRatio * step_q6_ && diff <= kMaxRatio * step_q6_
                          : diff_q6 > 0 && diff <= first_limit_q6_;
  if (fits && damaged_between == 0) {
    accept(diff_q6);
    return {Relation::kAdjacent, 0};
  }

  const bool repeats = std::abs(diff_q6 - rejected_q6_) * 5 <= rejected_q6_;
  rejections_ = damaged_between == 0 && diff_q6 > 0 && repeats ? rejections_ + 1 : 1;
  rejected_q6_ = diff_q6;
  if (rejections_ >= (known ? kNewSpeed : kFirstSpeed)) {
    step_q6_ = diff;
    rejections_ = 0;
    return {Relation::kAdjacent, 0};
  }

  if (!known) return {};
  if (diff_q6 > kMaxGapQ6) return {Relation::kUnknown, 1};
  const float periods = diff / step_q6_;
  const float whole = std::round(periods);
  if (whole < 1 || std::abs(periods - whole) > kWholeTolerance) {
    return {Relation::kUnknown, 1};
  }
  return {Relation::kGap, static_cast<int>(whole) - 1};
}

void CapsuleGapDetector::accept(int diff_q6) {
  const auto diff = static_cast<float>(diff_q6);
  step_q6_ = step_q6_ > 0 ? step_q6_ + (diff - step_q6_) * kSpeedGain : diff;
  rejections_ = 0;
}

void CapsuleDecoder::lock(WireFormat format, bool same_stream) {
  if (same_stream && format == format_) {
    contiguous_ = false;
    return;
  }
  format_ = format;
  has_pending_ = false;
  contiguous_ = true;
  damaged_ = 0;
  scan_began_in_gap_ = false;
  gap_detector_.reset(format);
}

Step CapsuleDecoder::step(ByteWindow& window, std::uint64_t& index, RawSampleSink& sink) {
  const std::size_t size = capsule_size(format_);
  const auto bytes = window.unread();
  if (bytes.size() < 2) return Step::kMore;
  if (!has_capsule_sync(bytes, format_)) return Step::kLost;
  if (bytes.size() < size) return Step::kMore;
  const auto capsule = bytes.first(size);
  if (!has_right_checksum(capsule, format_)) {
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
  if (has_pending_ && begins_stream(next, format_)) {
    drop_pending(index);
    sink.on_gap();
  } else if (has_pending_) {
    const int start_q6 = start_angle_q6(pending_, format_);
    const int diff_q6 =
        (start_angle_q6(next, format_) - start_q6 + kFullRevolutionQ6) % kFullRevolutionQ6;
    const auto [relation, missing] = gap_detector_.classify(diff_q6, damaged_);
    if (relation == CapsuleGapDetector::Relation::kAdjacent && contiguous_) {
      decode_pending(next, diff_q6, index, sink);
      index += capsule_samples(format_);
    } else {
      const int damaged = damaged_;
      const bool one_missing = relation == CapsuleGapDetector::Relation::kGap && missing == 1;
      if (one_missing) {
        // At constant speed each of the two capsules spans half the angle.
        decode_pending({}, diff_q6 / 2, index, sink);
        index += capsule_samples(format_);
        has_pending_ = false;
      } else {
        drop_pending(index);
      }
      const int gap_start_q6 = one_missing ? start_q6 + diff_q6 / 2 : start_q6;
      if (relation == CapsuleGapDetector::Relation::kUnknown) {
        counters_->lost_capsules += static_cast<std::uint64_t>(missing);
        sink.on_gap();
        scan_began_in_gap_ = false;
      } else {
        counters_->lost_capsules += static_cast<std::uint64_t>(std::max(0, missing - damaged));
        index += static_cast<std::uint64_t>(missing) * capsule_samples(format_);
        const bool wraps =
            gap_start_q6 < kFullRevolutionQ6 && start_q6 + diff_q6 >= kFullRevolutionQ6;
        scan_began_in_gap_ = scan_began_in_gap_ || wraps;
      }
    }
  }
  std::copy(next.begin(), next.end(), pending_.begin());
  has_pending_ = true;
  contiguous_ = true;
  damaged_ = 0;
}

void CapsuleDecoder::drop_pending(std::uint64_t& index) {
  if (!has_pending_) return;
  ++counters_->unpaired_capsules;
  index += capsule_samples(format_);
  has_pending_ = false;
  damaged_ = 0;
}

void CapsuleDecoder::decode_pending(std::span<const std::uint8_t> next, int diff_q6,
                                    std::uint64_t index, RawSampleSink& sink) {
  std::array<SweepSample, kMaxCapsuleSamples> buffer;
  const auto samples = std::span(buffer).first(capsule_samples(format_));
  const Sweep sweep{.start_q6 = start_angle_q6(pending_, format_), .diff_q6 = diff_q6};
  decode_capsule(format_, std::span(pending_).first(capsule_size(format_)), next, sweep, samples);
  for (const SweepSample& sample : samples) {
    const bool starts_scan = sample.starts_scan || scan_began_in_gap_;
    scan_began_in_gap_ = false;
    ++counters_->samples;
    if (starts_scan) ++counters_->scans;
    sink.on_sample({.index = index++,
                    .angle_q6 = sample.angle_q6,
                    .dist_q2 = sample.dist_q2,
                    .quality = sample.quality,
                    .starts_scan = starts_scan});
  }
}

}  // namespace cornerd::rplidar
