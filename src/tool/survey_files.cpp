// SPDX-License-Identifier: MIT
#include "tool/survey_files.hpp"

#include <cstdio>
#include <optional>
#include <utility>
#include <vector>

#include "core/scan.hpp"
#include "message/json_text.hpp"
#include "tool/failure.hpp"
#include "tool/odometry_file.hpp"

namespace cornerd::tool {

namespace {

class SurveySink final : public replay::RecordingSink {
 public:
  SurveySink(survey::RecordedDrive& drive, bool takes_odometry)
      : drive_(drive), takes_odometry_(takes_odometry) {}

  void on_sample(const core::Sample& sample) override {
    now_ns_ = sample.t_ns;
    if (assembler_.add(sample, turn_)) drive_.add(turn_);
  }
  void on_gap() override { finish(); }
  void on_odometry(const message::OdometryReading& reading) override {
    if (takes_odometry_) drive_.add(reading, now_ns_);
  }
  void finish() {
    if (assembler_.finish(turn_)) drive_.add(turn_);
    assembler_.reset();
  }

 private:
  survey::RecordedDrive& drive_;
  bool takes_odometry_;
  core::TurnAssembler assembler_;
  core::Scan turn_;
  std::optional<core::TimeNs> now_ns_;
};

}  // namespace

survey::RecordedDrive load_drive(std::span<const std::filesystem::path> files,
                                 const replay::RecordingOptions& options,
                                 const std::filesystem::path& odometry) {
  survey::RecordedDrive drive;
  SurveySink sink(drive, odometry.empty());
  for (const std::filesystem::path& file : files) {
    replay::RecordingPlayer player(file, options);
    while (player.step(sink)) {
    }
    sink.finish();
    if (player.bad_lines() > 0) {
      std::fprintf(stderr, "%s: %llu lines passed over; the first: %s\n", file.c_str(),
                   static_cast<unsigned long long>(player.bad_lines()),
                   player.first_problem().c_str());
    }
  }
  if (drive.size() == 0) {
    throw Failure(files.front().string() + ": not one whole turn of a lidar in it");
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
