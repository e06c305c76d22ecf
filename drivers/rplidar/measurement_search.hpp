// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>

#include "drivers/rplidar/decoder.hpp"

namespace cornerd::rplidar {

/// Looks for measurements in what a port says by itself: packets whose checksums or check bits
/// hold, in any of the formats.
class MeasurementSearch : private RawSampleSink {
 public:
  void add(std::span<const std::uint8_t> bytes) { decoder_.feed(bytes, *this); }
  bool found() const { return found_; }

 private:
  void on_sample(const RawSample& /*sample*/) override { found_ = true; }
  void on_gap() override {}

  Decoder decoder_;
  bool found_ = false;
};

}  // namespace cornerd::rplidar
