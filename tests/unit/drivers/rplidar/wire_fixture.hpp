// SPDX-License-Identifier: MIT
// Bytes as an A1 sends them, and a sink for decoded samples.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <span>
#include <string_view>
#include <vector>

#include "drivers/rplidar/decoder.hpp"

namespace cornerd::rplidar::test {

using Bytes = std::vector<std::uint8_t>;

Bytes from_hex(std::string_view hex);
Bytes join(std::initializer_list<Bytes> parts);

inline const Bytes kStandardDescriptor = {0xA5, 0x5A, 0x05, 0x00, 0x00, 0x40, 0x81};
inline const Bytes kExpressDescriptor = {0xA5, 0x5A, 0x54, 0x00, 0x00, 0x40, 0x82};
inline const Bytes kDenseDescriptor = {0xA5, 0x5A, 0x54, 0x00, 0x00, 0x40, 0x85};
inline const Bytes kUltraDenseDescriptor = {0xA5, 0x5A, 0xAA, 0x00, 0x00, 0x40, 0x86};
inline const Bytes kHqDescriptor = {0xA5, 0x5A, 0x0D, 0x03, 0x00, 0x40, 0x83};
inline const Bytes kUltraDescriptor = {0xA5, 0x5A, 0x84, 0x00, 0x00, 0x40, 0x84};

Bytes node(bool start, int quality, double angle_deg, double dist_mm);

/// `count` nodes of a head that rotates by `step_deg` per node from `from_deg` on. As on a real A1,
/// nodes with a return (three of four) have an angle up to 8 degrees smaller than those without,
/// and the first node of a revolution has the start flag. Distances identify the nodes.
Bytes nodes(int count, double from_deg, double step_deg = 1.14);
/// Distance of the n-th of those nodes.
std::uint32_t node_dist_q2(int n);

struct ExpressSample {
  int dist_mm = 0;
  int correction_q3 = 0;
};
Bytes express_capsule(double start_deg, bool stream_start,
                      const std::array<ExpressSample, 32>& samples);
/// `count` capsules in a row, `step_deg` apart; sample k of capsule c is 1000 + 32 * c + k mm away.
std::vector<Bytes> express_capsules(int count, double from_deg, double step_deg = 21.4);
std::uint32_t express_dist_q2(int capsule, int sample);

struct UltraCabin {
  int major = 0;  ///< varbit code
  int predict1 = 0;
  int predict2 = 0;
};
Bytes ultra_capsule(double start_deg, bool stream_start, const std::array<UltraCabin, 32>& cabins);
std::vector<Bytes> ultra_capsules(int count, double from_deg, double step_deg = 32);

/// `count` capsules of 40 samples; sample k of capsule c is 1000 + 40 * c + k mm away.
std::vector<Bytes> dense_capsules(int count, double from_deg, double step_deg = 28.8);

/// A sample of an ultra-dense capsule as the wire has it.
struct ScaledSample {
  int scale = 0;
  int steps = 0;
  int quality = 0;  ///< its upper bits alone: 8 - scale of them
};
Bytes ultra_dense_capsule(double start_deg, bool stream_start,
                          const std::array<ScaledSample, 64>& samples);
std::vector<Bytes> ultra_dense_capsules(int count, double from_deg, double step_deg = 7.2);

/// `count` packets of 96 nodes a degree's quarter apart, 1000 + 96 * c + k mm away.
std::vector<Bytes> hq_packets(int count, double from_deg);

Bytes join(std::span<const Bytes> parts);

class CollectingSink : public RawSampleSink {
 public:
  void on_sample(const RawSample& sample) override { samples.push_back(sample); }
  void on_gap() override { gaps.push_back(samples.size()); }

  std::vector<std::uint32_t> distances() const;
  std::size_t scans() const;

  std::vector<RawSample> samples;
  std::vector<std::size_t> gaps;  ///< number of samples before each
};

/// Decodes all of `bytes` and finishes.
CollectingSink decode(std::span<const std::uint8_t> bytes, Decoder& decoder);
CollectingSink decode(std::span<const std::uint8_t> bytes,
                      std::optional<WireFormat> format = std::nullopt);

}  // namespace cornerd::rplidar::test
