// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstddef>

#include "drivers/config/lidar_models.hpp"
#include "settings/map_file.hpp"
#include "tool/doctor/checks.hpp"
#include "tool/drawing/text_table.hpp"

namespace cornerd::tool {

namespace {

/// The median of fewer is no measurement.
constexpr std::size_t kMinScans = 5;
/// Residuals of simulated scans are 0.66 to 1.03 of the noise (README.md).
constexpr double kLargestRatio = 2;
constexpr double kSmallestRatio = 0.2;

/// The row of a model as STATUS names it ("A1M8"); null if there is none.
const drivers::LidarModel* model_of(const DaemonView& daemon) {
  std::string name = daemon.status ? daemon.status->lidar_model : "";
  for (char& c : name) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  for (const drivers::LidarModel& model : drivers::kLidarModels) {
    if (name.starts_with(model.name)) return &model;
  }
  return nullptr;
}

/// Without noise in the config the daemon takes that of the lidar's model.
bool is_default(const settings::LidarConfig& lidar) {
  const drivers::LidarModel* const model = drivers::first_lidar_model(lidar.driver);
  const core::SensorNoise own = model != nullptr ? model->noise() : core::SensorNoise{};
  const core::SensorNoise& noise = lidar.noise.sensor;
  return noise.table.empty() && noise.floor_m == own.floor_m && noise.share == own.share;
}

double median_of(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// Of the returns: more than a few beyond the range are no mirages.
constexpr double kManyBeyond = 0.05;

}  // namespace

std::vector<Finding> check_range(const Patient& patient) {
  const std::vector<float>& returns_m = patient.daemon.scan_returns_m;
  const double max_m = patient.config.lidar.max_range_m;
  const auto beyond = static_cast<double>(std::ranges::count_if(
      returns_m, [&](float range_m) { return static_cast<double>(range_m) > max_m; }));
  const double share = beyond / static_cast<double>(std::max(returns_m.size(), std::size_t{1}));
  if (share < kManyBeyond) return {};
  const auto farthest_m = static_cast<double>(*std::ranges::max_element(returns_m));
  return {{Verdict::kNote,
           "range",
           formatted("%.0f %% of the lidar's returns, up to %.1f m, are beyond "
                     "advanced.lidar.max_range, %g m, and are not used",
                     100 * share, farthest_m, max_m),
           {formatted("unless they are wrong: \"advanced\": { \"lidar\": { \"max_range\": %.0f } }",
                      std::ceil(farthest_m))}}};
}

std::vector<Finding> check_residuals(const Patient& patient) {
  const DaemonView& daemon = patient.daemon;
  const settings::Config& config = patient.config;
  if (daemon.rmse_m.size() < kMinScans || daemon.scan_returns_m.empty()) return {};
  const drivers::LidarModel* const model = is_default(config.lidar) ? model_of(daemon) : nullptr;
  const core::SensorNoise noise = model != nullptr ? model->noise() : config.lidar.noise.sensor;
  double map_sigma_m = 0;
  try {
    map_sigma_m =
        settings::parse_floor_plan(settings::read_map_text(config.map), config.map).sigma_m;
  } catch (const settings::SettingsError&) {
    return {};  // reported by other checks
  }
  double variance_m2 = 0;
  for (const float range_m : daemon.scan_returns_m) {
    const double sigma_m = noise.sigma_range_m(double{range_m});
    variance_m2 += sigma_m * sigma_m / static_cast<double>(daemon.scan_returns_m.size());
  }
  const double expected_m = std::sqrt(variance_m2);
  const double measured_m = median_of(daemon.rmse_m);
  const std::string what =
      formatted("residuals of the scans: %.1f mm; by %s: %.1f mm", 1000 * measured_m,
                is_default(config.lidar) ? "the noise of the lidar's model" : "lidar.noise",
                1000 * expected_m);
  const std::string remedy =
      "record half a minute at rest and run cornerctl calibrate noise still.bin -o noise.json";
  if (measured_m > std::hypot(kLargestRatio * expected_m, map_sigma_m)) {
    return {{Verdict::kNote,
             "noise",
             what + ": poses are less exact than their covariance",
             {remedy,
              "if that agrees with the noise in use, walls are not where the map has them: "
              "measure them, or give the map its \"sigma\""}}};
  }
  if (measured_m < kSmallestRatio * expected_m) {
    return {
        {Verdict::kNote, "noise", what + ": poses are more exact than their covariance", {remedy}}};
  }
  return {{Verdict::kGood, "noise", what}};
}

}  // namespace cornerd::tool
