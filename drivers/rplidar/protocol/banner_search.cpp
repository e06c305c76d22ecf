// SPDX-License-Identifier: MIT
#include "drivers/rplidar/protocol/banner_search.hpp"

#include <string_view>

namespace cornerd::rplidar {
namespace {

constexpr std::string_view kFirstWords = "RP LIDAR";

}  // namespace

bool BannerSearch::add(std::span<const std::uint8_t> bytes) {
  bool found = false;
  for (const std::uint8_t byte : bytes) {
    const char character = static_cast<char>(byte);
    // No beginning of these words comes again inside of them: a mismatch begins them anew at most.
    if (character != kFirstWords[matched_]) matched_ = 0;
    if (character == kFirstWords[matched_]) ++matched_;
    if (matched_ < kFirstWords.size()) continue;
    found = true;
    matched_ = 0;
  }
  return found;
}

}  // namespace cornerd::rplidar
