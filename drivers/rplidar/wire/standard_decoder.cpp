// SPDX-License-Identifier: MIT
#include "drivers/rplidar/wire/standard_decoder.hpp"

#include <algorithm>

#include "drivers/rplidar/wire/byte_window.hpp"
#include "drivers/rplidar/wire/standard_node.hpp"

namespace cornerd::rplidar {
namespace {

// After more bytes (6 ms) the number of lost nodes is unknown.
constexpr std::size_t kMaxRelockBytes = 64;

}  // namespace

void StandardDecoder::lock() {
  has_front_ = false;
  confirmed_ = 0;
  search_offset_ = 0;
  scans_.forget();
}

Step StandardDecoder::step(ByteWindow& window, std::uint64_t& index, bool final,
                           RawSampleSink& sink) {
  if (search_offset_ > 0) return relock(window, index, final, sink);
  if (!has_front_) return begin(window);
  const auto bytes = window.unread();
  if (bytes.size() < 2 * kNodeSize) return final ? end(window, index, sink) : Step::kMore;

  const auto next = parse_standard_node(bytes.subspan(kNodeSize));
  const bool plausible =
      next && track_.is_consistent(*next, 1) && !(next->start_flag && !track_.near_zero());
  if (!plausible) {
    search_offset_ = 1;
    return relock(window, index, final, sink);
  }
  deliver_front(window, index, sink);
  ++index;
  advance(*next, 1);
  return Step::kProgress;
}

Step StandardDecoder::begin(ByteWindow& window) {
  const auto bytes = window.unread();
  if (bytes.size() < kNodeSize) return Step::kMore;
  const auto node = parse_standard_node(bytes);
  if (!node) return Step::kLost;
  front_ = *node;
  track_.begin(front_);
  front_starts_scan_ = scans_.advance(front_.start_flag, track_);
  counters_->false_scan_starts = scans_.false_starts();
  has_front_ = true;
  return Step::kProgress;
}

// The node after the front is inconsistent: it is damaged, or the boundary has moved within the
// front or after it. Every offset from there on is tried.
Step StandardDecoder::relock(ByteWindow& window, std::uint64_t& index, bool final,
                             RawSampleSink& sink) {
  for (; search_offset_ <= kMaxRelockBytes; ++search_offset_) {
    const std::size_t offset = search_offset_;
    const auto bytes = window.unread();
    if (bytes.size() < offset + kNodeSize && final) return end(window, index, sink);
    const auto rest = bytes.subspan(std::min(offset, bytes.size()));

    const auto descriptor = match_scan_descriptor(rest);
    if (descriptor.verdict == Verdict::kMore && !final) return Step::kMore;
    if (descriptor.verdict == Verdict::kYes) {
      const bool front_is_whole = offset == kNodeSize;
      if (front_is_whole) {
        deliver_front(window, index, sink);
      } else {
        skip(window, offset);
      }
      ++index;
      return Step::kLost;
    }

    const int periods = std::max(1, static_cast<int>((offset + 2) / kNodeSize));
    const ChainMatch chain = match_node_chain(rest, &track_, periods, final);
    if (chain.verdict == Verdict::kMore) return Step::kMore;
    if (chain.verdict == Verdict::kNo) continue;

    const bool aligned = offset % kNodeSize == 0;
    // On every real A1 the first node after a descriptor is stale, with any angle.
    const bool fresh = confirmed_ == 0;
    if (fresh && !chain.continues_track) front_starts_scan_ = false;
    std::size_t to_skip = offset;
    if (aligned && (chain.continues_track || fresh)) {
      deliver_front(window, index, sink);
      to_skip -= kNodeSize;
    }
    if (aligned) {
      counters_->bad_nodes += offset / kNodeSize - 1;
    } else {
      ++counters_->resyncs;
    }
    skip(window, to_skip);
    index += static_cast<std::uint64_t>(periods);
    search_offset_ = 0;
    if (chain.continues_track) {
      advance(*parse_standard_node(rest), periods);
      return Step::kProgress;
    }
    if (!fresh) sink.on_gap();
    scans_.forget();
    has_front_ = false;
    return Step::kProgress;
  }
  ++counters_->resyncs;
  skip(window, search_offset_);
  ++index;
  return Step::kLost;
}

// The end of a recording cannot be confirmed; one node beyond the last confirmed one is accepted.
Step StandardDecoder::end(ByteWindow& window, std::uint64_t& index, RawSampleSink& sink) {
  deliver_front(window, index, sink);
  ++index;
  const auto rest = window.unread();
  if (rest.size() >= kNodeSize) {
    const auto node = parse_standard_node(rest);
    if (node && (!node->start_flag || track_.near_zero())) {
      advance(*node, 1);
      deliver_front(window, index, sink);
      ++index;
    }
  }
  skip(window, window.unread().size());
  return Step::kLost;
}

void StandardDecoder::advance(const StandardNode& node, int periods) {
  track_.advance(node, periods);
  front_ = node;
  front_starts_scan_ = scans_.advance(node.start_flag, track_);
  counters_->false_scan_starts = scans_.false_starts();
  ++confirmed_;
}

void StandardDecoder::deliver_front(ByteWindow& window, std::uint64_t index, RawSampleSink& sink) {
  window.consume(kNodeSize);
  counters_->used_bytes += kNodeSize;
  ++counters_->samples;
  if (front_starts_scan_) ++counters_->scans;
  sink.on_sample({.index = index,
                  .angle_q6 = front_.angle_q6,
                  .dist_q2 = front_.dist_q2,
                  .quality = front_.quality,
                  .starts_scan = front_starts_scan_});
}

void StandardDecoder::skip(ByteWindow& window, std::size_t count) {
  counters_->skipped_bytes += count;
  window.consume(count);
}

}  // namespace cornerd::rplidar
