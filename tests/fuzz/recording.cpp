// SPDX-License-Identifier: MIT
// Any bytes, as .bin and as .ndjson, play to the end, with every sample within its limits.
#include "replay/recording.hpp"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <sstream>
#include <string>

namespace {

using cornerd::replay::RecordingKind;

struct CheckingSink : cornerd::replay::RecordingSink {
  void on_sample(const cornerd::core::Sample& sample) override {
    if (!std::isfinite(sample.range_m) || sample.range_m < 0) std::abort();
    if (!(std::abs(sample.bearing_rad) <= 3.1415928F)) std::abort();
  }
  void on_gap() override {}
  void on_odometry(const cornerd::message::OdometryReading&) override {}
};

void play(const std::string& text, RecordingKind kind) {
  std::istringstream stream(text);
  cornerd::replay::RecordingPlayer player(stream, kind, {});
  CheckingSink sink;
  while (player.step(sink)) {
  }
  if (player.first_problem().empty() != (player.bad_lines() == 0)) std::abort();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string text(reinterpret_cast<const char*>(data), size);
  play(text, RecordingKind::kBytes);
  play(text, RecordingKind::kMessages);
  return 0;
}
