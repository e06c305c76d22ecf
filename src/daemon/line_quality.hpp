// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

namespace cornerd::daemon {

/// Of the lidar's bytes of about the last ten STATUS messages, those that were no part of a packet.
class LineQuality {
 public:
  /// Counters since the start; they fall where a port is opened anew.
  void add(std::uint64_t bytes, std::uint64_t skipped) {
    const bool goes_on = bytes >= last_bytes_ && skipped >= last_skipped_;
    bytes_ = kMemory * bytes_ + (goes_on ? static_cast<double>(bytes - last_bytes_) : 0);
    skipped_ = kMemory * skipped_ + (goes_on ? static_cast<double>(skipped - last_skipped_) : 0);
    last_bytes_ = bytes;
    last_skipped_ = skipped;
  }
  double skipped_share() const { return bytes_ > kLeastBytes ? skipped_ / bytes_ : 0; }
  /// Half of an A1's scans have no pose where 2 to 3 % of the bytes are lost and 22 % skipped.
  bool is_damaged() const { return skipped_share() > kDamaged; }

 private:
  static constexpr double kMemory = 0.9;
  static constexpr double kLeastBytes = 10'000;  ///< two seconds of an A1's
  static constexpr double kDamaged = 0.1;

  double bytes_ = 0;
  double skipped_ = 0;
  std::uint64_t last_bytes_ = 0;
  std::uint64_t last_skipped_ = 0;
};

}  // namespace cornerd::daemon
