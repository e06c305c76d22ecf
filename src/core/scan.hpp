// SPDX-License-Identifier: MIT
// One revolution's samples, and the segmentation of the sample stream into scans.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "core/types.hpp"

namespace cornerd::core {

/// An A1 at its slowest (1 Hz) in its fastest mode (127 us a sample) gives 7,874 samples a scan;
/// `cornerd-bench` goes up to 10,000.
inline constexpr std::size_t kMaxSamplesPerScan = 10240;

/// The samples of one scan in the order of arrival. Takes room for kMaxSamplesPerScan at
/// construction: filling and reusing a scan allocates nothing.
class Scan {
 public:
  Scan() { samples_.reserve(kMaxSamplesPerScan); }

  void clear() { samples_.clear(); }

  /// False, with nothing added, where the scan is full.
  bool add(const Sample& sample) {
    if (samples_.size() >= kMaxSamplesPerScan) return false;
    samples_.push_back(sample);
    return true;
  }

  /// Takes the samples of `other`, the last one first, at the times of the first to the last.
  void assign_reversed(const Scan& other);

  /// Moves all times to another clock that is `by_ns` ahead.
  void shift(TimeNs by_ns) {
    for (Sample& sample : samples_) sample.t_ns += by_ns;
  }

  std::span<const Sample> samples() const { return samples_; }
  std::size_t size() const { return samples_.size(); }
  bool empty() const { return samples_.empty(); }

  /// Time of the first sample; 0 for an empty scan.
  TimeNs start_ns() const { return empty() ? 0 : samples_.front().t_ns; }
  /// Time of the last sample; 0 for an empty scan.
  TimeNs end_ns() const { return empty() ? 0 : samples_.back().t_ns; }

 private:
  std::vector<Sample> samples_;
};

/// Segments the sample stream into scans: a scan ends where the next revolution starts or the
/// source marks its end. The first scan of a stream is its first complete revolution.
class ScanAssembler {
 public:
  /// True where `sample` completes a scan; `scan` then holds it (swapped, not copied).
  bool add(const Sample& sample, Scan& scan);

  /// At the end of a recording: hands out the scan in progress where it covers at least 350
  /// degrees. True where `scan` was filled.
  bool finish(Scan& scan);

  /// Drops the scan in progress: the device was reopened, or the stream has a gap.
  void reset();

  /// Samples beyond kMaxSamplesPerScan, and those of incomplete scans.
  std::size_t dropped() const { return dropped_; }

 private:
  Scan collecting_;
  bool collects_ = false;  ///< the scan in progress was received from its start
  std::size_t dropped_ = 0;
};

}  // namespace cornerd::core
