// SPDX-License-Identifier: MIT
#include "settings/noise.hpp"

#include <vector>

#include "settings/config.hpp"

namespace cornerd::settings {
namespace {

constexpr std::size_t kMaxNoiseBytes = 1 << 20;

/// A sigma of 0 would make every return infinitely good.
constexpr Interval kSigmaM = {1e-5, 1};

core::SigmaTable::Point read_sigma(ObjectReader point) {
  core::SigmaTable::Point read;
  if (!point.number("range", read.range_m, {0.01, 100})) point.fail("range", "is missing");
  if (!point.number("sigma", read.sigma_m, kSigmaM)) point.fail("sigma", "is missing");
  point.finish();
  return read;
}

void read_table(ObjectReader& noise, core::SigmaTable& table) {
  constexpr std::string_view kKey = "ranges";
  const Json* array = noise.find(kKey);
  if (array == nullptr) return;
  if (!array->is_array()) noise.fail(kKey, "must be a list of { \"range\", \"sigma\" }");
  if (array->size() > core::SigmaTable::kMaxPoints) {
    noise.fail(kKey, "has more than " + std::to_string(core::SigmaTable::kMaxPoints) + " entries");
  }
  std::vector<core::SigmaTable::Point> points;
  for (std::size_t i = 0; i < array->size(); ++i) {
    points.push_back(read_sigma(noise.element(kKey, *array, i)));
    if (i > 0 && points[i].range_m <= points[i - 1].range_m) {
      noise.fail(kKey, i, "must be of a longer range than the one before");
    }
  }
  table = core::SigmaTable(points);
}

}  // namespace

void read_noise(ObjectReader noise, core::SensorNoise& config) {
  noise.number("floor", config.floor_m, kSigmaM);
  noise.number("share", config.share, {0, 1});
  noise.number("bearing", config.bearing_rad, {0, 0.1});
  read_table(noise, config.table);
  noise.finish();
}

core::SensorNoise load_noise(const std::filesystem::path& file) {
  const std::string text = read_file(file, kMaxNoiseBytes);
  const Config config = parse_config(text, file, {}, /*require_map=*/false);
  if (!parse_document(text, file).contains(Json::json_pointer("/lidar/noise"))) {
    throw SettingsError(file.string(), "/lidar/noise", "is missing");
  }
  return config.lidar.noise;
}

}  // namespace cornerd::settings
