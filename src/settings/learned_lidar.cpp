// SPDX-License-Identifier: MIT
#include "settings/learned_lidar.hpp"

#include <algorithm>
#include <cstdint>

#include <nlohmann/json.hpp>

#include "settings/object_reader.hpp"
#include "settings/sensor_bias.hpp"

namespace cornerd::settings {
namespace {

constexpr std::string_view kFormat = "cornerd-lidar";
constexpr std::size_t kMaxSerialBytes = 64;
constexpr std::uint32_t kMaxScans = 4'000'000'000;

/// No number of turns makes a bias known better than a micrometre, a millionth, a microradian.
constexpr double kLeastSigma = 1e-6;

bool is_possible(const core::SensorBias& sigma) {
  return std::min({sigma.range_scale, sigma.range_offset_m, sigma.bearing_sine_rad,
                   sigma.bearing_cosine_rad}) >= kLeastSigma;
}

}  // namespace

LearnedLidar parse_learned_lidar(std::string_view text, const std::filesystem::path& file) {
  const DocumentContext context{.file = file};
  const Json document = parse_document(text, file);
  ObjectReader root(context, document, "");
  std::string format;
  root.text("format", format, kFormat.size());
  if (format != kFormat) root.fail("format", "must be \"" + std::string(kFormat) + "\"");
  LearnedLidar lidar;
  root.text("serial", lidar.serial, kMaxSerialBytes);
  read_bias(root.object("configured"), lidar.configured);
  read_bias(root.object("bias"), lidar.learned.bias);
  read_bias(root.object("sigma"), lidar.learned.sigma);
  if (!is_possible(lidar.learned.sigma)) root.fail("sigma", "must be 1e-6 at least, all of it");
  std::uint32_t scans = 0;
  root.integer("turns", scans, std::uint32_t{1}, kMaxScans);
  if (scans == 0) root.fail("turns", "is missing");
  lidar.learned.scans = scans;
  root.finish();
  return lidar;
}

std::string text_of(const LearnedLidar& lidar) {
  nlohmann::ordered_json document = {{"format", kFormat}};
  if (!lidar.serial.empty()) document["serial"] = lidar.serial;
  document["configured"] = json_of(lidar.configured);
  document["bias"] = json_of(lidar.learned.bias);
  document["sigma"] = json_of(lidar.learned.sigma);
  document["turns"] = std::min<std::size_t>(lidar.learned.scans, kMaxScans);
  return document.dump(2, ' ', false, Json::error_handler_t::replace) + '\n';
}

}  // namespace cornerd::settings
