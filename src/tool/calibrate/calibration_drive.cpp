// SPDX-License-Identifier: MIT
#include "tool/calibrate/calibration_drive.hpp"

#include <cstdlib>
#include <utility>

#include "calibration/drive_monitor.hpp"
#include "core/pipeline.hpp"
#include "replay/recording.hpp"
#include "settings/map_file.hpp"
#include "tool/command_line/command.hpp"
#include "tool/replay/other_odometry.hpp"
#include "tool/replay/playback.hpp"

namespace cornerd::tool {

namespace {

constexpr core::TimeNs kMaxClockOffset_ns = 2 * core::kNsPerSecond;

/// Drops poses that go back in time.
void add_pose(const calibration::KnownPose& place, std::vector<calibration::KnownPose>& places) {
  if (places.empty() || place.t_ns > places.back().t_ns) places.push_back(place);
}

void add_fix(const core::ScanResult& result, std::vector<calibration::KnownPose>& places) {
  const core::PoseEstimate& pose = result.pose;
  if (pose.state == core::PoseState::kFix) add_pose({pose.t_ns, pose.T_map_base}, places);
}

/// Collects increments, readings and poses of the drive.
class DriveSink final : public replay::RecordingSink {
 public:
  DriveSink(core::Pipeline& pipeline, const core::OdometryConfig& odometry, const Truth* truth)
      : pipeline_(pipeline),
        gate_(odometry),
        wide_gate_(calibration::with_wide_limits(odometry)),
        truth_(truth) {}

  void on_sample(const core::Sample& sample) override {
    now_ns_ = sample.t_ns;
    take(pipeline_.add(sample));
  }
  void on_gap() override { take(pipeline_.finish()); }
  void on_odometry(const message::OdometryReading& reading) override {
    drive_.readings.push_back(reading);
    pipeline_.add(reading);
    const core::OdometryReading timed = reading.arrived(arrival_time(reading.t_ns));
    if (const auto step = gate_.add(timed)) drive_.steps.push_back(*step);
    if (const auto step = wide_gate_.add(timed))
      drive_.increments_within_wide_limits.push_back(*step);
  }
  CalibrationDrive finish() {
    take(pipeline_.finish());
    drive_.counters = gate_.counters();
    return std::move(drive_);
  }

 private:
  /// Time of the lidar's newest sample, or of the reading if they are near: the fit finds the
  /// delay.
  std::optional<core::TimeNs> arrival_time(core::TimeNs t_ns) const {
    const bool is_near = now_ns_ && std::abs(t_ns - *now_ns_) < kMaxClockOffset_ns;
    return is_near ? t_ns : now_ns_;
  }

  void take(const core::ScanResult* result) {
    if (result == nullptr) return;
    if (truth_ == nullptr) return add_fix(*result, drive_.places);
    const core::TimeNs t_ns = result->pose.t_ns;
    if (const auto T_map_base = truth_->at(t_ns)) add_pose({t_ns, *T_map_base}, drive_.places);
  }

  core::Pipeline& pipeline_;
  core::ReadingGate gate_;
  core::ReadingGate wide_gate_;
  const Truth* truth_;
  std::optional<core::TimeNs> now_ns_;
  CalibrationDrive drive_;
};

/// Feeds readings whose times were changed.
class PoseSink final : public replay::RecordingSink {
 public:
  PoseSink(core::Pipeline& pipeline, std::vector<core::OdometryReading> readings)
      : pipeline_(pipeline), readings_(std::move(readings)) {}

  void on_sample(const core::Sample& sample) override {
    readings_.take_until(sample.t_ns, [&](const core::OdometryReading& reading) {
      pipeline_.add(reading.arrived(sample.t_ns));
    });
    take(pipeline_.add(sample));
  }
  void on_gap() override { take(pipeline_.finish()); }
  void on_odometry(const message::OdometryReading& /*reading*/) override {}
  std::vector<calibration::KnownPose> finish() {
    take(pipeline_.finish());
    return std::move(places_);
  }

 private:
  void take(const core::ScanResult* result) {
    if (result != nullptr) add_fix(*result, places_);
  }

  core::Pipeline& pipeline_;
  TimedReadings readings_;
  std::vector<calibration::KnownPose> places_;
};

void play(const DriveFile& file, const settings::Config& config, replay::RecordingSink& sink) {
  replay::RecordingPlayer player(file.file, {file.wire, config.lidar.mount.inverted});
  while (player.step(sink)) {
  }
}

}  // namespace

void DriveOptions::add_drive(Command& command, const std::string& what, const std::string& key) {
  command.add_option("file", file, "a drive with ODOMETRY lines (.ndjson): " + what)
      .required()
      .type_name("FILE");
  command
      .add_option("--odometry", odometry,
                  "ODOMETRY lines of another file, in place of the recording's own")
      .type_name("FILE");
  add(command, key);
}

CalibrationDrive play_drive(const DriveFile& file, const settings::Config& config,
                            const Truth* truth, bool deskewed) {
  core::LocalizerConfig localizer = config.localizer();
  localizer.odometry.enabled = deskewed;
  core::Pipeline pipeline(truth != nullptr ? nullptr : settings::load_map(config.map), localizer);
  DriveSink sink(pipeline, config.odometry.core, truth);
  if (file.odometry.empty()) {
    play(file, config, sink);
  } else {
    OtherOdometry other(sink, load_odometry(file.odometry));
    play(file, config, other);
  }
  return sink.finish();
}

std::vector<calibration::KnownPose> localize_drive(const DriveFile& file,
                                                   const settings::Config& config,
                                                   std::vector<core::OdometryReading> readings,
                                                   double delay_s) {
  for (core::OdometryReading& reading : readings) reading.t_ns -= core::from_seconds(delay_s);
  core::LocalizerConfig localizer = config.localizer();
  localizer.odometry.enabled = true;
  localizer.odometry.initial.delay_s = 0;
  core::Pipeline pipeline(settings::load_map(config.map), localizer);
  PoseSink sink(pipeline, std::move(readings));
  play(file, config, sink);
  return sink.finish();
}

}  // namespace cornerd::tool
