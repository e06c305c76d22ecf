// SPDX-License-Identifier: MIT
#include "daemon/calibration_file.hpp"

#include <cmath>
#include <cstdlib>
#include <system_error>
#include <utility>

#include "daemon/log.hpp"
#include "daemon/replace_file.hpp"
#include "settings/document.hpp"

namespace cornerd::daemon {
namespace {

/// With fewer scans sigma exceeds the bias of most A1s.
constexpr std::size_t kMinScans = 20;
/// A new estimate is written if a parameter changed by this multiple of sigma, or sigma shrank to
/// this share.
constexpr double kMinChangeSigmas = 0.5;
constexpr double kMinSigmaRatio = 0.7;

constexpr double core::SensorBias::*kParts[] = {
    &core::SensorBias::range_scale, &core::SensorBias::range_offset_m,
    &core::SensorBias::bearing_sine_rad, &core::SensorBias::bearing_cosine_rad};

/// True for a calibration file, and for the remains of one after a power cut: truncated, empty, or
/// zeros.
bool is_own(std::string_view text) {
  if (text.find_first_not_of('\0') == std::string_view::npos) return true;
  const std::string all = settings::text_of(settings::LidarCalibration{});
  const std::string_view begin = std::string_view(all).substr(0, all.find('\n', 2));
  return text.substr(0, begin.size()) == begin.substr(0, text.size());
}

}  // namespace

std::filesystem::path calibration_file_path(const settings::LidarConfig& config) {
  if (config.driver == settings::DriverKind::kReplay) return {};
  if (!config.calibration_file.empty()) return config.calibration_file;
  const char* const folder = std::getenv("STATE_DIRECTORY");
  if (folder == nullptr || *folder == '\0') return {};
  return std::filesystem::path(folder) / "lidar.json";
}

CalibrationFile::CalibrationFile(const std::filesystem::path& file,
                                 const core::SensorBias& configured) {
  content_.configured = configured;
  if (file.empty()) return;
  // The target of a symbolic link is replaced, not the link.
  std::error_code unresolved;
  file_ = std::filesystem::weakly_canonical(file, unresolved);
  if (unresolved) file_ = file;
  load();
}

void CalibrationFile::load() {
  using std::filesystem::file_type;
  std::error_code unread;
  const file_type type = std::filesystem::status(file_, unread).type();
  if (type == file_type::not_found) return;
  const auto leave_alone = [this](std::string_view why) {
    problem_ = std::string(why) +
               "; the lidar's calibration is not stored: set another "
               "/advanced/lidar/calibration_file";
    log(LogLevel::kWarning, problem_);
    file_.clear();
  };
  if (type != file_type::regular) return leave_alone(file_.string() + ": not a regular file");
  std::string text;
  try {
    text = settings::read_file(file_, settings::kMaxLidarCalibrationBytes,
                               settings::FileKind::kOrdinary);
  } catch (const std::exception& error) {
    return leave_alone(error.what());
  }
  try {
    settings::LidarCalibration found = settings::parse_lidar_calibration(text, file_);
    if (found.configured != content_.configured) {
      log(LogLevel::kInfo, file_.string() + ": not used, since /advanced/lidar/bias has changed");
      return;
    }
    content_ = std::move(found);
    written_ = content_.learned;
    log(LogLevel::kInfo, file_.string() + ": the lidar's bias is known from " +
                             std::to_string(written_.scans) + " scans");
  } catch (const std::exception& error) {
    // A file given by mistake is neither overwritten nor moved.
    if (!is_own(text)) return leave_alone(error.what());
    log(LogLevel::kWarning,
        std::string("the lidar's stored calibration is not used: ") + error.what());
  }
}

bool CalibrationFile::identify(std::string_view serial) {
  if (serial.empty() || serial == content_.serial) return true;
  const bool is_another = !content_.serial.empty();
  content_.serial = serial;
  if (is_another) content_.learned = written_ = {};
  return !is_another;
}

bool CalibrationFile::reconfigure(const core::SensorBias& configured) {
  if (configured == content_.configured) return true;
  content_.configured = configured;
  content_.learned = written_ = {};
  return false;
}

bool CalibrationFile::is_significant() const {
  if (written_.scans == 0) return true;
  for (const auto part : kParts) {
    const double sigma = written_.sigma.*part;
    if (std::abs(content_.learned.bias.*part - written_.bias.*part) > kMinChangeSigmas * sigma)
      return true;
    if (content_.learned.sigma.*part < kMinSigmaRatio * sigma) return true;
  }
  return false;
}

void CalibrationFile::update(const core::EstimatedBias& learned) {
  if (learned.scans <= content_.learned.scans) return;
  content_.learned = learned;
  if (file_.empty() || learned.scans < kMinScans || !is_significant()) return;
  try {
    replace_file(file_, settings::text_of(content_));
    written_ = learned;
    problem_.clear();
  } catch (const std::exception& error) {
    const bool is_known = !problem_.empty();
    problem_ = std::string("cannot store the lidar's calibration: ") + error.what();
    if (!is_known) log(LogLevel::kWarning, problem_);
  }
}

}  // namespace cornerd::daemon
