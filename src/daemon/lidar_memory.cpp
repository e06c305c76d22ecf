// SPDX-License-Identifier: MIT
#include "daemon/lidar_memory.hpp"

#include <spdlog/spdlog.h>

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <system_error>
#include <utility>

#include "settings/document.hpp"

namespace cornerd::daemon {
namespace {

/// Fewer turns tell less than what an A1 may be off by.
constexpr std::size_t kLeastTurns = 20;
/// News is what differs by this share of its sigma, or is so much better known.
constexpr double kNewsSigmas = 0.5;
constexpr double kNewsOfSigma = 0.7;

constexpr double core::SensorBias::*kParts[] = {
    &core::SensorBias::range_scale, &core::SensorBias::range_offset_m,
    &core::SensorBias::bearing_sine_rad, &core::SensorBias::bearing_cosine_rad};

/// Either the old file or the new one is there, whenever the power fails.
void replace_file(const std::filesystem::path& file, const std::string& text) {
  const std::filesystem::path fresh = file.string() + ".new";
  std::ofstream stream(fresh, std::ios::binary | std::ios::trunc);
  stream << text << std::flush;
  if (!stream) throw std::system_error(errno, std::generic_category(), fresh.string());
  stream.close();
  std::filesystem::rename(fresh, file);
}

}  // namespace

std::filesystem::path learned_file(const settings::LidarConfig& config) {
  if (config.driver == settings::DriverKind::kReplay || !config.learn_bias) return {};
  if (!config.learned_file.empty()) return config.learned_file;
  const char* const folder = std::getenv("STATE_DIRECTORY");
  if (folder == nullptr || *folder == '\0') return {};
  return std::filesystem::path(folder) / "lidar.json";
}

LidarMemory::LidarMemory(std::filesystem::path file, const core::SensorBias& configured)
    : file_(std::move(file)) {
  kept_.configured = configured;
}

std::optional<core::LearnedBias> LidarMemory::recall() {
  std::error_code unread;
  if (file_.empty() ||
      std::filesystem::status(file_, unread).type() == std::filesystem::file_type::not_found) {
    return std::nullopt;
  }
  try {
    const std::string text = settings::read_file(file_, settings::kMaxLearnedLidarBytes);
    settings::LearnedLidar found = settings::parse_learned_lidar(text, file_);
    if (found.configured != kept_.configured) {
      spdlog::info("{}: learnt under another /lidar/bias, and not used", file_.string());
      return std::nullopt;
    }
    kept_ = std::move(found);
  } catch (const std::exception& error) {
    spdlog::warn("what was learnt of the lidar is not used: {}", error.what());
    return std::nullopt;
  }
  spdlog::info("the lidar's bias is known from {} turns before", kept_.learned.turns);
  return kept_.learned;
}

bool LidarMemory::recognise(std::string_view serial) {
  if (serial.empty() || serial == kept_.serial) return true;
  const bool is_another = !kept_.serial.empty();
  kept_.serial = serial;
  if (!is_another) return true;
  kept_.learned = {};
  forgets_ = true;
  return false;
}

void LidarMemory::reconfigure(const core::SensorBias& configured) {
  if (configured == kept_.configured) return;
  kept_.configured = configured;
  kept_.learned = {};
  forgets_ = true;
}

bool LidarMemory::is_news(const core::LearnedBias& learned) const {
  if (kept_.learned.turns == 0) return true;
  for (const auto part : kParts) {
    const double sigma = kept_.learned.sigma.*part;
    if (std::abs(learned.bias.*part - kept_.learned.bias.*part) > kNewsSigmas * sigma) return true;
    if (learned.sigma.*part < kNewsOfSigma * sigma) return true;
  }
  return false;
}

void LidarMemory::keep(const core::LearnedBias& learned) {
  // Until a turn comes that knows nothing yet, it is of the lidar or the settings before.
  if (learned.turns < kLeastTurns) forgets_ = false;
  if (file_.empty() || forgets_ || learned.turns < kLeastTurns || !is_news(learned)) return;
  kept_.learned = learned;
  try {
    replace_file(file_, settings::text_of(kept_));
  } catch (const std::exception& error) {
    if (!complained_) spdlog::warn("what was learnt of the lidar is not kept: {}", error.what());
    complained_ = true;
  }
}

}  // namespace cornerd::daemon
