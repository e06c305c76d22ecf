// SPDX-License-Identifier: MIT
#include "tool/survey/survey_files.hpp"

#include <algorithm>
#include <cstdio>
#include <optional>
#include <utility>
#include <vector>

#include "core/scan.hpp"
#include "message/json_text.hpp"
#include "tool/command_line/failure.hpp"
#include "tool/replay/playback.hpp"

namespace cornerd::tool {

namespace {

/// Inserted before a file whose clock restarts.
constexpr core::TimeNs kGapBetweenClocks_ns = core::kNsPerSecond;
/// Between two readings of one clock.
constexpr core::TimeNs kMaxReadingInterval_ns = core::kNsPerSecond / 2;

class SurveySink final : public replay::RecordingSink {
 public:
  SurveySink(survey::RecordedDrive& drive, bool takes_odometry)
      : drive_(drive), takes_odometry_(takes_odometry) {}

  /// Starts the next file.
  void begin_file() {
    is_first_ = true;
    shift_ns_ = 0;
    now_ns_.reset();
  }
  /// Added to the file's times; 0 if they follow the file before.
  core::TimeNs shift_ns() const { return shift_ns_; }

  void on_sample(const core::Sample& sample) override {
    core::Sample shifted = sample;
    shifted.t_ns = shifted_ns(sample.t_ns);
    now_ns_ = shifted.t_ns;
    if (assembler_.add(shifted, scan_)) drive_.add(scan_);
  }
  void on_gap() override { finish(); }
  void on_odometry(const message::OdometryReading& reading) override {
    message::OdometryReading shifted = reading;
    shifted.t_ns = shifted_ns(reading.t_ns);
    // Consecutive readings advance the time while the lidar is silent.
    if (now_ns_ && shifted.t_ns < *now_ns_ + kMaxReadingInterval_ns) {
      now_ns_ = std::max(*now_ns_, shifted.t_ns);
    }
    if (takes_odometry_) drive_.add(shifted.arrived(now_ns_));
  }
  void finish() {
    if (assembler_.finish(scan_)) drive_.add(scan_);
    assembler_.reset();
  }

 private:
  core::TimeNs shifted_ns(core::TimeNs t_ns) {
    if (is_first_ && latest_ns_ && t_ns < *latest_ns_) {
      shift_ns_ = *latest_ns_ + kGapBetweenClocks_ns - t_ns;
    }
    is_first_ = false;
    t_ns += shift_ns_;
    latest_ns_ = std::max(latest_ns_.value_or(t_ns), t_ns);
    return t_ns;
  }

  survey::RecordedDrive& drive_;
  bool takes_odometry_;
  core::ScanAssembler assembler_;
  core::Scan scan_;
  std::optional<core::TimeNs> now_ns_;
  bool is_first_ = true;  ///< of the file: its clock is not known yet
  core::TimeNs shift_ns_ = 0;
  std::optional<core::TimeNs> latest_ns_;  ///< of all files so far
};

}  // namespace

survey::RecordedDrive load_drive(std::span<const std::filesystem::path> files,
                                 const replay::RecordingOptions& options,
                                 const std::filesystem::path& odometry) {
  survey::RecordedDrive drive;
  SurveySink sink(drive, odometry.empty());
  for (const std::filesystem::path& file : files) {
    const std::size_t scans_before = drive.size();
    replay::RecordingPlayer player(file, options);
    sink.begin_file();
    while (player.step(sink)) {
    }
    sink.finish();
    std::fputs(player.report().c_str(), stderr);
    if (drive.size() == scans_before) {
      throw Failure(file.string() + ": not one complete scan in it" +
                    (files.size() > 1 ? "; name a file of ODOMETRY lines with --odometry" : ""));
    }
    if (sink.shift_ns() == 0) continue;
    if (!odometry.empty()) {
      throw Failure(
          file.string() +
          ": its clock begins before the end of the previous recording, so the times of " +
          odometry.string() + " are ambiguous; survey without --odometry");
    }
    std::fprintf(stderr,
                 "%s: its clock begins before the end of the previous recording; its times are "
                 "shifted by %.3f s\n",
                 file.c_str(), core::to_seconds(sink.shift_ns()));
  }
  if (!odometry.empty()) drive.set_odometry(load_odometry(odometry));
  return drive;
}

std::string trajectory_text(const survey::SurveyResult& result) {
  message::JsonText json(128);
  std::string text;
  for (std::size_t i = 0; i < result.t_ns.size(); ++i) {
    const core::Pose2& T_map_base = result.T_map_base[i];
    json.clear();
    json.open_object();
    json.key("t");
    json.seconds(result.t_ns[i]);
    json.key("x");
    json.fixed(T_map_base.x_m, 6);
    json.key("y");
    json.fixed(T_map_base.y_m, 6);
    json.key("theta");
    json.angle(T_map_base.theta_rad);
    json.close_object();
    text.append(json.view()).append("\n");
  }
  return text;
}

}  // namespace cornerd::tool
