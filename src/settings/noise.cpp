// SPDX-License-Identifier: MIT
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "settings/config_table.hpp"

namespace cornerd::settings {
namespace {

constexpr std::size_t kMaxNoiseBytes = 1 << 20;
constexpr double kMaxCoefficient = 1e6;

core::SigmaTable::Point read_sigma(ObjectReader point) {
  core::SigmaTable::Point read;
  if (!point.number("range", read.range_m, {0.01, 100})) point.fail("range", "is missing");
  if (!point.number("sigma", read.sigma_m, kSigmaM)) point.fail("sigma", "is missing");
  point.finish();
  return read;
}

void read_table(ObjectReader& noise, std::string_view key, core::SigmaTable& table) {
  const Json* array = noise.find(key);
  if (array == nullptr) return;
  if (!array->is_array()) noise.fail(key, "must be a list of { \"range\", \"sigma\" }");
  if (array->size() > core::SigmaTable::kMaxPoints) {
    noise.fail(key, "has more than " + std::to_string(core::SigmaTable::kMaxPoints) + " entries");
  }
  std::vector<core::SigmaTable::Point> points;
  for (std::size_t i = 0; i < array->size(); ++i) {
    points.push_back(read_sigma(noise.element(key, *array, i)));
    if (i > 0 && points[i].range_m <= points[i - 1].range_m) {
      noise.fail(key, i, "must be of a longer range than the one before");
    }
  }
  table = core::SigmaTable(points);
}

void read_coefficients(ObjectReader& piece, calibration::WallPiece& read) {
  constexpr std::string_view kKey = "coefficients";
  const Json* rows = piece.find(kKey);
  if (rows == nullptr) piece.fail(kKey, "is missing");
  if (!rows->is_array() || rows->size() > read.coefficients.size()) {
    piece.fail(kKey, "must be a list of at most " + std::to_string(read.coefficients.size()) +
                         " lists, one for each power of the ray");
  }
  for (std::size_t i = 0; i < rows->size(); ++i) {
    const Json& row = (*rows)[i];
    auto& target = read.coefficients[i];
    if (!row.is_array() || row.size() > target.size()) {
      piece.fail(kKey, i,
                 "must be a list of at most " + std::to_string(target.size()) +
                     " numbers, one for each power of the distance");
    }
    for (std::size_t j = 0; j < row.size(); ++j) {
      if (!row[j].is_number() || !(std::abs(row[j].get<double>()) <= kMaxCoefficient)) {
        piece.fail(kKey, i,
                   "must hold numbers from -" + to_text(kMaxCoefficient) + " to " +
                       to_text(kMaxCoefficient));
      }
      target[j] = row[j].get<double>();
    }
  }
}

calibration::WallPiece read_piece(ObjectReader piece) {
  calibration::WallPiece read;
  if (!piece.number("from", read.from_m, {0, 100})) piece.fail("from", "is missing");
  if (!piece.number("to", read.to_m, {0, 100})) piece.fail("to", "is missing");
  if (read.to_m < read.from_m) piece.fail("to", "must not be less than from");
  if (!piece.number("ray", read.ray_rad, {0, 1.57})) piece.fail("ray", "is missing");
  if (!piece.number("sigma", read.sigma_m, kSigmaM)) piece.fail("sigma", "is missing");
  read_coefficients(piece, read);
  piece.finish();
  return read;
}

void read_wall_model(ObjectReader& noise, std::string_view key, calibration::WallModel& model) {
  const Json* array = noise.find(key);
  if (array == nullptr) return;
  if (!array->is_array()) noise.fail(key, "must be a list of { \"from\", \"to\", ... }");
  if (array->size() > calibration::kMaxWallPieces) {
    noise.fail(key, "has more than " + std::to_string(calibration::kMaxWallPieces) + " entries");
  }
  std::vector<calibration::WallPiece> pieces;
  for (std::size_t i = 0; i < array->size(); ++i) {
    pieces.push_back(read_piece(noise.element(key, *array, i)));
    if (i > 0 && pieces[i].to_m <= pieces[i - 1].to_m) {
      noise.fail(key, i, "must reach farther than the one before");
    }
  }
  model = calibration::WallModel(std::move(pieces));
}

}  // namespace

Value sigma_table(core::SigmaTable& table) {
  return {[&table](ObjectReader& noise, std::string_view key) { read_table(noise, key, table); },
          [] { return nlohmann::ordered_json::array(); },
          "at most " + std::to_string(core::SigmaTable::kMaxPoints) + " entries"};
}

Value wall_model(calibration::WallModel& model) {
  return {
      [&model](ObjectReader& noise, std::string_view key) { read_wall_model(noise, key, model); },
      [] { return nlohmann::ordered_json::array(); },
      "at most " + std::to_string(calibration::kMaxWallPieces) + " entries"};
}

NoiseConfig load_noise(const std::filesystem::path& file) {
  const std::string text = read_file(file, kMaxNoiseBytes);
  const Config config = parse_config(text, file, {}, /*require_map=*/false);
  if (!parse_document(text, file).contains(Json::json_pointer("/lidar/noise"))) {
    throw SettingsError(file.string(), "/lidar/noise", "is missing");
  }
  return config.lidar.noise;
}

}  // namespace cornerd::settings
