// SPDX-License-Identifier: MIT
// One turn of the sensor, and what cuts the stream of samples into turns.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "core/types.hpp"

namespace cornerd::core {

/// An A1 at its slowest (1 Hz) and its fastest mode (127 us a sample) gives 7,874 samples a turn;
/// `cornerd-bench` goes up to 10,000.
inline constexpr std::size_t kMaxSamplesPerScan = 10240;

/// The samples of one turn in the order of their arrival. Room for kMaxSamplesPerScan is taken at
/// construction, so that filling and reusing one allocates nothing.
class Scan {
 public:
  Scan() { samples_.reserve(kMaxSamplesPerScan); }

  void clear() { samples_.clear(); }

  /// False, and nothing added, where the turn is full.
  bool add(const Sample& sample) {
    if (samples_.size() >= kMaxSamplesPerScan) return false;
    samples_.push_back(sample);
    return true;
  }

  /// Sets all times to another clock, `by_ns` ahead.
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

/// Collects samples until a revolution is complete: the next one starts, or the source says that it
/// ends. A stream joined in the middle of a turn gives its first scan at the end of the first whole
/// one.
class ScanAssembler {
 public:
  /// True when `sample` completed a turn, which `turn` now holds. It is swapped in, never copied;
  /// nothing is allocated.
  bool add(const Sample& sample, Scan& scan);

  /// The end of a recording: hands out the turn in progress where it has gone round all but 10
  /// degrees. True where `turn` was filled.
  bool finish(Scan& scan);

  /// Forgets the turn in progress: the device was reopened, the stream has a hole.
  void reset();

  /// Samples beyond kMaxSamplesPerScan, and those of turns that were begun but never ended.
  std::size_t dropped() const { return dropped_; }

 private:
  Scan collecting_;
  bool collects_ = false;  ///< a turn has begun that was seen from its start
  std::size_t dropped_ = 0;
};

}  // namespace cornerd::core
