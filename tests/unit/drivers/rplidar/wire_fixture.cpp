// SPDX-License-Identifier: MIT
#include "wire_fixture.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <numeric>

namespace cornerd::rplidar::test {
namespace {

void put_u16(Bytes& bytes, int value) {
  bytes.push_back(static_cast<std::uint8_t>(value));
  bytes.push_back(static_cast<std::uint8_t>(value >> 8));
}

int to_q6(double angle_deg) { return static_cast<int>(std::lround(angle_deg * 64)) % (360 * 64); }

Bytes capsule_header(double start_deg, bool stream_start) {
  Bytes bytes{0, 0};
  put_u16(bytes, to_q6(start_deg) | (stream_start ? 0x8000 : 0));
  return bytes;
}

Bytes sealed(Bytes capsule) {
  const int sum = std::accumulate(capsule.begin() + 2, capsule.end(), 0, std::bit_xor<>());
  capsule[0] = static_cast<std::uint8_t>(0xA0 | (sum & 0xF));
  capsule[1] = static_cast<std::uint8_t>(0x50 | sum >> 4);
  return capsule;
}

}  // namespace

Bytes from_hex(std::string_view hex) {
  Bytes bytes;
  for (std::size_t i = 0; i < hex.size(); i += 2) {
    while (i < hex.size() && hex[i] == ' ') ++i;
    std::uint8_t byte = 0;
    std::from_chars(hex.data() + i, hex.data() + i + 2, byte, 16);
    bytes.push_back(byte);
  }
  return bytes;
}

Bytes join(std::span<const Bytes> parts) {
  Bytes whole;
  for (const Bytes& part : parts) whole.insert(whole.end(), part.begin(), part.end());
  return whole;
}

Bytes join(std::initializer_list<Bytes> parts) {
  return join(std::span(parts.begin(), parts.size()));
}

Bytes node(bool start, int quality, double angle_deg, double dist_mm) {
  Bytes bytes{static_cast<std::uint8_t>(quality << 2 | (start ? 1 : 2))};
  put_u16(bytes, static_cast<int>(std::lround(angle_deg * 64)) << 1 | 1);
  put_u16(bytes, static_cast<int>(std::lround(dist_mm * 4)));
  return bytes;
}

std::uint32_t node_dist_q2(int n) {
  return n % 4 == 3 ? 0 : static_cast<std::uint32_t>(2000 + 13 * n % 30000);
}

Bytes nodes(int count, double from_deg, double step_deg) {
  Bytes bytes;
  for (int n = 0; n < count; ++n) {
    const double raw_deg = from_deg + n * step_deg;
    const bool start = std::floor(raw_deg / 360) > std::floor((raw_deg - step_deg) / 360);
    const std::uint32_t dist_q2 = node_dist_q2(n);
    const double correction_deg = dist_q2 > 0 ? 3 + 5.0 * (n % 7) / 6 : 0;
    const double angle_deg = std::fmod(raw_deg - correction_deg + 360, 360);
    const Bytes one = node(start, dist_q2 > 0 ? 15 : 0, angle_deg, dist_q2 / 4.0);
    bytes.insert(bytes.end(), one.begin(), one.end());
  }
  return bytes;
}

Bytes express_capsule(double start_deg, bool stream_start,
                      const std::array<ExpressSample, 32>& samples) {
  Bytes bytes = capsule_header(start_deg, stream_start);
  for (std::size_t k = 0; k < samples.size(); k += 2) {
    put_u16(bytes, samples[k].dist_mm << 2 | samples[k].correction_q3 >> 4);
    put_u16(bytes, samples[k + 1].dist_mm << 2 | samples[k + 1].correction_q3 >> 4);
    bytes.push_back(static_cast<std::uint8_t>((samples[k].correction_q3 & 0xF) |
                                              (samples[k + 1].correction_q3 & 0xF) << 4));
  }
  return sealed(bytes);
}

std::uint32_t express_dist_q2(int capsule, int sample) {
  return static_cast<std::uint32_t>(1000 + (32 * capsule + sample) % 15000) * 4;
}

std::vector<Bytes> express_capsules(int count, double from_deg, double step_deg) {
  std::vector<Bytes> capsules;
  for (int c = 0; c < count; ++c) {
    std::array<ExpressSample, 32> samples;
    for (int k = 0; k < 32; ++k) {
      samples[static_cast<std::size_t>(k)] = {static_cast<int>(express_dist_q2(c, k) / 4), k};
    }
    capsules.push_back(express_capsule(std::fmod(from_deg + c * step_deg, 360), c == 0, samples));
  }
  return capsules;
}

Bytes ultra_capsule(double start_deg, bool stream_start, const std::array<UltraCabin, 32>& cabins) {
  Bytes bytes = capsule_header(start_deg, stream_start);
  for (const UltraCabin& cabin : cabins) {
    const std::uint32_t word = static_cast<std::uint32_t>(cabin.major) |
                               (static_cast<std::uint32_t>(cabin.predict1) & 0x3FF) << 12 |
                               (static_cast<std::uint32_t>(cabin.predict2) & 0x3FF) << 22;
    put_u16(bytes, static_cast<int>(word & 0xFFFF));
    put_u16(bytes, static_cast<int>(word >> 16));
  }
  return sealed(bytes);
}

std::vector<Bytes> ultra_capsules(int count, double from_deg, double step_deg) {
  std::vector<Bytes> capsules;
  for (int c = 0; c < count; ++c) {
    std::array<UltraCabin, 32> cabins;
    for (int n = 0; n < 32; ++n) {
      cabins[static_cast<std::size_t>(n)] = {600 + (32 * c + n) % 1000, n % 5, -(n % 3)};
    }
    capsules.push_back(ultra_capsule(std::fmod(from_deg + c * step_deg, 360), c == 0, cabins));
  }
  return capsules;
}

std::vector<Bytes> dense_capsules(int count, double from_deg, double step_deg) {
  std::vector<Bytes> capsules;
  for (int c = 0; c < count; ++c) {
    Bytes bytes = capsule_header(std::fmod(from_deg + c * step_deg, 360), c == 0);
    for (int k = 0; k < 40; ++k) put_u16(bytes, 1000 + 40 * c + k);
    capsules.push_back(sealed(bytes));
  }
  return capsules;
}

Bytes ultra_dense_capsule(double start_deg, bool stream_start,
                          const std::array<ScaledSample, 64>& samples) {
  Bytes bytes = {0, 0, 0x12, 0x34, 0x56, 0x78, 0x9A, 0xBC};  // time and status
  put_u16(bytes, to_q6(start_deg) | (stream_start ? 0x8000 : 0));
  const auto word = [](const ScaledSample& sample) {
    return sample.quality << (12 + sample.scale) | sample.steps << 2 | sample.scale;
  };
  for (std::size_t k = 0; k < samples.size(); k += 2) {
    put_u16(bytes, word(samples[k]) & 0xFFFF);
    put_u16(bytes, word(samples[k + 1]) & 0xFFFF);
    bytes.push_back(
        static_cast<std::uint8_t>(word(samples[k]) >> 16 | word(samples[k + 1]) >> 16 << 4));
  }
  return sealed(bytes);
}

std::vector<Bytes> ultra_dense_capsules(int count, double from_deg, double step_deg) {
  std::vector<Bytes> capsules;
  for (int c = 0; c < count; ++c) {
    std::array<ScaledSample, 64> samples;
    for (int k = 0; k < 64; ++k) {
      samples[static_cast<std::size_t>(k)] = {0, 100 + (64 * c + k) % 900, 200};
    }
    capsules.push_back(
        ultra_dense_capsule(std::fmod(from_deg + c * step_deg, 360), c == 0, samples));
  }
  return capsules;
}

std::vector<Bytes> hq_packets(int count, double from_deg) {
  std::vector<Bytes> packets;
  double angle_deg = from_deg;
  for (int c = 0; c < count; ++c) {
    Bytes bytes = {0xA5, 1, 2, 3, 4, 5, 6, 7, 8};
    for (int k = 0; k < 96; ++k) {
      const bool starts = std::fmod(angle_deg, 360) < 0.25;
      put_u16(bytes, static_cast<int>(std::lround(std::fmod(angle_deg, 360) * 16384 / 90)));
      put_u16(bytes, 4 * (1000 + 96 * c + k));
      put_u16(bytes, 0);
      bytes.push_back(0xBC);
      bytes.push_back(starts ? 1 : 0);
      angle_deg += 0.25;
    }
    std::uint32_t crc = 0xFFFFFFFF;  // of IEEE 802.3, over the packet and three zeros
    for (std::size_t i = 0; i < bytes.size() + 3; ++i) {
      crc ^= i < bytes.size() ? bytes[i] : 0U;
      for (int bit = 0; bit < 8; ++bit) crc = crc >> 1 ^ ((crc & 1) != 0 ? 0xEDB88320U : 0U);
    }
    put_u16(bytes, static_cast<int>(~crc & 0xFFFF));
    put_u16(bytes, static_cast<int>(~crc >> 16));
    packets.push_back(bytes);
  }
  return packets;
}

std::vector<std::uint32_t> CollectingSink::distances() const {
  std::vector<std::uint32_t> distances;
  for (const RawSample& sample : samples) distances.push_back(sample.dist_q2);
  return distances;
}

std::size_t CollectingSink::scans() const {
  return static_cast<std::size_t>(std::count_if(
      samples.begin(), samples.end(), [](const RawSample& sample) { return sample.starts_scan; }));
}

CollectingSink decode(std::span<const std::uint8_t> bytes, Decoder& decoder) {
  CollectingSink sink;
  decoder.feed(bytes, sink);
  decoder.finish(sink);
  return sink;
}

CollectingSink decode(std::span<const std::uint8_t> bytes, std::optional<WireFormat> format) {
  Decoder decoder(format);
  return decode(bytes, decoder);
}

}  // namespace cornerd::rplidar::test
