// SPDX-License-Identifier: MIT
// One packet of a triangulating YDLIDAR (X2, X4), as in the development manuals of both:
// AA 55, type, number of samples, first and last angle, check code, samples. Little-endian.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace cornerd::ydlidar {

inline constexpr std::size_t kHeaderSize = 10;
/// Between samples.
inline constexpr double kPeriodX4S = 1 / 5'000.0;
inline constexpr double kPeriodX2S = 1 / 3'000.0;

/// Fields of a packet; its bytes must outlive it.
struct Packet {
  std::size_t samples = 0;
  bool is_zero_packet = false;  ///< of one sample, at the zero mark
  double rate_hz = 0;           ///< of the revolutions; 0: not told
  float first_deg = 0;          ///< of the first sample, without correction, in [0, 512)
  float last_deg = 0;
  std::span<const std::uint8_t> ranges;

  /// Sample `i`, millimetres * 4; 0: no return.
  int dist_q2(std::size_t i) const { return ranges[2 * i] | ranges[2 * i + 1] << 8; }
};

/// Whether a packet begins here: header, at least one sample, check bits of both angles.
bool has_header(std::span<const std::uint8_t, kHeaderSize> bytes);
/// Of the packet that begins here, bytes.
std::size_t packet_size(std::span<const std::uint8_t, kHeaderSize> header);
/// `bytes`: packet_size() of them.
bool has_right_check_code(std::span<const std::uint8_t> bytes);
Packet parse_packet(std::span<const std::uint8_t> bytes);

/// What the triangulation adds to the angle of a sample; 0 without a return.
float angle_correction_deg(int dist_q2);

}  // namespace cornerd::ydlidar
