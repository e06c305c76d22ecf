// SPDX-License-Identifier: MIT
#include "settings/lidar_calibration.hpp"

#include <algorithm>
#include <cstdint>

#include <nlohmann/json.hpp>

#include "settings/config_table.hpp"

namespace cornerd::settings {
namespace {

constexpr std::string_view kFormat = "cornerd-lidar";
constexpr std::size_t kMaxSerialBytes = 64;
constexpr std::uint32_t kMaxScans = 4'000'000'000;

/// Metres, radians or a share: a smaller sigma can only be an error in the file.
constexpr double kMinSigma = 1e-6;

void read_bias(ObjectReader bias, core::SensorBias& config) {
  bias.number("range_scale", config.range_scale, {-0.1, 0.1});
  bias.number("range_offset", config.range_offset_m, {-0.1, 0.1});
  bias.number("bearing_sine", config.bearing_sine_rad, {-0.1, 0.1});
  bias.number("bearing_cosine", config.bearing_cosine_rad, {-0.1, 0.1});
  bias.finish();
}

bool is_possible(const core::SensorBias& sigma) {
  return std::min({sigma.range_scale, sigma.range_offset_m, sigma.bearing_sine_rad,
                   sigma.bearing_cosine_rad}) >= kMinSigma;
}

}  // namespace

Value sensor_bias(core::SensorBias& bias) {
  return {
      [&bias](ObjectReader& object, std::string_view key) { read_bias(object.object(key), bias); },
      [&bias] { return json_of(bias); }, "each -0.1 to 0.1"};
}

nlohmann::ordered_json json_of(const core::SensorBias& bias) {
  return {{"range_scale", bias.range_scale},
          {"range_offset", bias.range_offset_m},
          {"bearing_sine", bias.bearing_sine_rad},
          {"bearing_cosine", bias.bearing_cosine_rad}};
}

LidarCalibration parse_lidar_calibration(std::string_view text, const std::filesystem::path& file) {
  const DocumentContext context{.file = file};
  const Json document = parse_document(text, file);
  ObjectReader root(context, document, "");
  std::string format;
  root.text("format", format, kFormat.size());
  if (format != kFormat) root.fail("format", "must be \"" + std::string(kFormat) + "\"");
  LidarCalibration calibration;
  root.text("serial", calibration.serial, kMaxSerialBytes);
  read_bias(root.object("configured"), calibration.configured);
  read_bias(root.object("bias"), calibration.learned.bias);
  read_bias(root.object("sigma"), calibration.learned.sigma);
  if (!is_possible(calibration.learned.sigma))
    root.fail("sigma", "must be 1e-6 at least, all of it");
  std::uint32_t scans = 0;
  root.integer("scans", scans, std::uint32_t{1}, kMaxScans);
  if (root.find("turns") != nullptr) root.fail("turns", "moved; write /scans instead");
  if (scans == 0) root.fail("scans", "is missing");
  calibration.learned.scans = scans;
  root.finish();
  return calibration;
}

std::string text_of(const LidarCalibration& calibration) {
  nlohmann::ordered_json document = {{"format", kFormat}};
  if (!calibration.serial.empty()) document["serial"] = calibration.serial;
  document["configured"] = json_of(calibration.configured);
  document["bias"] = json_of(calibration.learned.bias);
  document["sigma"] = json_of(calibration.learned.sigma);
  document["scans"] = std::min<std::size_t>(calibration.learned.scans, kMaxScans);
  return document.dump(2, ' ', false, Json::error_handler_t::replace) + '\n';
}

}  // namespace cornerd::settings
