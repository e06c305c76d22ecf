// SPDX-License-Identifier: MIT
#include "daemon/lidar_memory.hpp"

#include <cmath>
#include <cstdlib>
#include <system_error>
#include <utility>

#include "daemon/log.hpp"
#include "daemon/replace_file.hpp"
#include "settings/document.hpp"

namespace cornerd::daemon {
namespace {

/// Fewer turns tell less than what an A1 may be off by.
constexpr std::size_t kMinScans = 20;
/// News is what differs by this share of its sigma, or is so much better known.
constexpr double kNewsSigmas = 0.5;
constexpr double kNewsOfSigma = 0.7;

constexpr double core::SensorBias::*kParts[] = {
    &core::SensorBias::range_scale, &core::SensorBias::range_offset_m,
    &core::SensorBias::bearing_sine_rad, &core::SensorBias::bearing_cosine_rad};

/// True for a file of its kind, or what a power cut or a failing disk left of one: the beginning,
/// nothing, or zeros.
bool is_own(std::string_view text) {
  if (text.find_first_not_of('\0') == std::string_view::npos) return true;
  const std::string all = settings::text_of({});
  const std::string_view begin = std::string_view(all).substr(0, all.find('\n', 2));
  return text.substr(0, begin.size()) == begin.substr(0, text.size());
}

bool is_json(std::string_view text) {
  return settings::Json::accept(text, /*ignore_comments=*/true);
}

}  // namespace

std::filesystem::path learned_file(const settings::LidarConfig& config) {
  if (config.driver == settings::DriverKind::kReplay) return {};
  if (!config.learned_file.empty()) return config.learned_file;
  const char* const folder = std::getenv("STATE_DIRECTORY");
  if (folder == nullptr || *folder == '\0') return {};
  return std::filesystem::path(folder) / "lidar.json";
}

LidarMemory::LidarMemory(const std::filesystem::path& file, const core::SensorBias& configured) {
  known_.configured = configured;
  if (file.empty()) return;
  // Where it is a link, what it leads to is replaced, not the link.
  std::error_code unresolved;
  file_ = std::filesystem::weakly_canonical(file, unresolved);
  if (unresolved) file_ = file;
  recall();
}

void LidarMemory::recall() {
  using std::filesystem::file_type;
  std::error_code unread;
  const file_type type = std::filesystem::status(file_, unread).type();
  if (type == file_type::not_found) return;
  const auto leave_alone = [this](std::string_view why) {
    log(LogLevel::kWarning, std::string(why) + "; what is learnt of the lidar is not kept");
    file_.clear();
  };
  if (type != file_type::regular) return leave_alone(file_.string() + ": is no ordinary file");
  std::string text;
  try {
    text =
        settings::read_file(file_, settings::kMaxLearnedLidarBytes, settings::FileKind::kOrdinary);
  } catch (const std::exception& error) {
    return leave_alone(error.what());
  }
  try {
    settings::LearnedLidar found = settings::parse_learned_lidar(text, file_);
    if (found.configured != known_.configured) {
      log(LogLevel::kInfo, file_.string() + ": learnt under another /lidar/bias, and not used");
      return;
    }
    known_ = std::move(found);
    written_ = known_.learned;
    log(LogLevel::kInfo,
        "the lidar's bias is known from " + std::to_string(written_.scans) + " turns before");
  } catch (const std::exception& error) {
    if (!is_own(text)) {
      // Somebody's settings or map, given by mistake, stay where they are.
      if (is_json(text)) return leave_alone(error.what());
      const std::filesystem::path aside = file_.string() + ".bad";
      std::error_code failed;
      std::filesystem::rename(file_, aside, failed);
      if (failed) return leave_alone(error.what());
      return log(LogLevel::kWarning, std::string(error.what()) + "; it is " + aside.string() +
                                         " now, and the lidar is learnt anew");
    }
    log(LogLevel::kWarning,
        std::string("what was learnt of the lidar is not used: ") + error.what());
  }
}

bool LidarMemory::recognise(std::string_view serial) {
  if (serial.empty() || serial == known_.serial) return true;
  const bool is_another = !known_.serial.empty();
  known_.serial = serial;
  if (is_another) known_.learned = written_ = {};
  return !is_another;
}

bool LidarMemory::reconfigure(const core::SensorBias& configured) {
  if (configured == known_.configured) return true;
  known_.configured = configured;
  known_.learned = written_ = {};
  return false;
}

bool LidarMemory::is_news() const {
  if (written_.scans == 0) return true;
  for (const auto part : kParts) {
    const double sigma = written_.sigma.*part;
    if (std::abs(known_.learned.bias.*part - written_.bias.*part) > kNewsSigmas * sigma)
      return true;
    if (known_.learned.sigma.*part < kNewsOfSigma * sigma) return true;
  }
  return false;
}

void LidarMemory::keep(const core::LearnedBias& learned) {
  if (learned.scans <= known_.learned.scans) return;
  known_.learned = learned;
  if (file_.empty() || learned.scans < kMinScans || !is_news()) return;
  try {
    replace_file(file_, settings::text_of(known_));
    written_ = learned;
  } catch (const std::exception& error) {
    if (!complained_) {
      log(LogLevel::kWarning,
          std::string("what was learnt of the lidar is not kept: ") + error.what());
    }
    complained_ = true;
  }
}

}  // namespace cornerd::daemon
