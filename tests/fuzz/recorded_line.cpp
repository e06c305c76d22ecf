// SPDX-License-Identifier: MIT
// Any bytes give a recorded message or an error; a scan among them is finite and can be written.
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>

#include <nlohmann/json.hpp>

#include "core/scan.hpp"
#include "message/line_writer.hpp"
#include "message/request.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace cornerd;
  static message::LineWriter writer;
  const std::string_view line(reinterpret_cast<const char*>(data), size);
  static_cast<void>(message::parse_truth_line(line));
  const auto recorded = message::parse_recorded_line(line);
  const auto* read = std::get_if<message::RecordedScan>(&recorded);
  if (read == nullptr) return 0;
  core::Scan scan;
  for (const core::Sample& sample : read->samples) {
    if (!std::isfinite(sample.bearing_rad) || !(sample.range_m >= 0)) std::abort();
    if (!scan.add(sample)) std::abort();
  }
  if (!nlohmann::json::accept(writer.scan(scan))) std::abort();
  return 0;
}
