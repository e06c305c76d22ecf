// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "drivers/lidar_status.hpp"

namespace cornerd::drivers {

/// The speeds that are tried in turn until one answers.
class BaudSearch {
 public:
  /// `rates`: at least one.
  explicit BaudSearch(std::vector<std::uint32_t> rates) : rates_(std::move(rates)) {}

  std::uint32_t current() const { return rates_[index_]; }
  bool is_single() const { return rates_.size() == 1; }
  /// "115200, 256000".
  std::string text() const {
    std::string text;
    for (const std::uint32_t rate : rates_) {
      text += (text.empty() ? "" : ", ") + std::to_string(rate);
    }
    return text;
  }

  /// The current speed has failed with kNoAnswer or kWrongBaud; the next one is current. What to
  /// report if all have failed now; nullopt: not yet.
  std::optional<LidarFault> fail(LidarFault fault) {
    has_noise_ = has_noise_ || fault == LidarFault::kWrongBaud;
    index_ = (index_ + 1) % rates_.size();
    if (index_ != 0) return std::nullopt;
    if (!std::exchange(has_noise_, false)) return LidarFault::kNoAnswer;
    return is_single() ? LidarFault::kWrongBaud : LidarFault::kUnexpectedData;
  }

 private:
  std::vector<std::uint32_t> rates_;
  std::size_t index_ = 0;
  bool has_noise_ = false;  ///< at one of those tried since the last report
};

}  // namespace cornerd::drivers
