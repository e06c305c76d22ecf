// SPDX-License-Identifier: MIT
#include "tool/replay/playback.hpp"

#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <string>
#include <thread>
#include <utility>
#include <variant>

#include "message/request.hpp"
#include "replay/line_reader.hpp"
#include "tool/command_line/failure.hpp"
#include "tool/replay/other_odometry.hpp"

namespace cornerd::tool {

class Playback::Sink : public replay::RecordingSink {
 public:
  explicit Sink(Playback& playback) : playback_(playback) {}

  void on_sample(const core::Sample& sample) override {
    playback_.on_result(playback_.pipeline_.add(sample));
    playback_.on_intermediate_pose(playback_.pipeline_.partial_pose());
  }
  void on_gap() override { playback_.on_result(playback_.pipeline_.finish()); }
  void on_odometry(const message::OdometryReading& reading) override { playback_.add(reading); }
  void on_refused_odometry(const message::RequestError& error) override {
    if (playback_.on_refusal_) playback_.on_refusal_(error);
  }

 private:
  Playback& playback_;
};

Playback::Playback(core::Pipeline& pipeline, OnScan on_scan, OnPiece on_piece)
    : pipeline_(pipeline), on_scan_(std::move(on_scan)), on_piece_(std::move(on_piece)) {}

void Playback::add(const core::OdometryReading& reading) {
  const core::PoseEstimate* const pose = pipeline_.add(reading);
  if (on_reading_) on_reading_(reading);
  on_intermediate_pose(pose);
}

void Playback::on_intermediate_pose(const core::PoseEstimate* pose) {
  if (pose != nullptr && on_prediction_) on_prediction_(*pose);
}

void Playback::on_result(const core::ScanResult* result) {
  if (result == nullptr) return;
  ++scans_;
  on_scan_(pipeline_.scan(), *result);
  if (independent_) pipeline_.localizer().forget_scans();
}

void Playback::play(const std::filesystem::path& file, const replay::RecordingOptions& options) {
  replay::RecordingPlayer player(file, options);
  Sink own(*this);
  std::optional<OtherOdometry> other;
  if (readings_) other.emplace(own, *readings_);
  replay::RecordingSink& sink = other ? static_cast<replay::RecordingSink&>(*other) : own;
  scans_ = 0;
  pipeline_.localizer().relocalize();
  while (player.step(sink)) {
    if (on_piece_) on_piece_(player.time_ns(), player.counters());
  }
  on_result(pipeline_.finish());
  if (on_piece_) on_piece_(player.time_ns(), player.counters());

  std::fputs(player.report().c_str(), stderr);
  if (scans_ == 0) throw Failure(file.string() + ": not one complete scan in it");
}

std::optional<double> parse_speed(const std::string& text) {
  if (text == "max") return std::nullopt;
  double speed = 0;
  const char* const end = text.data() + text.size();
  const auto [parsed_to, error] = std::from_chars(text.data(), end, speed);
  if (error != std::errc() || parsed_to != end || !std::isfinite(speed) || speed <= 0) {
    throw UsageError("--speed: '" + text + "' is neither max nor a number above 0");
  }
  return speed;
}

void Pace::wait_until(core::TimeNs data_ns) {
  if (!first_data_ns_) {
    first_data_ns_ = data_ns;
    began_ = Clock::now();
  }
  const std::chrono::duration<double, std::nano> wait(
      static_cast<double>(data_ns - *first_data_ns_) / speed_);
  std::this_thread::sleep_until(began_ + std::chrono::duration_cast<Clock::duration>(wait));
}

std::vector<core::OdometryReading> load_odometry(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  if (!stream) throw Failure(file.string() + ": " + std::strerror(errno));
  std::vector<core::OdometryReading> readings;
  replay::LineReader lines(stream, message::kMaxRecordedBytes);
  using Result = replay::LineReader::Result;
  for (Result result = lines.next(); result != Result::kEnd; result = lines.next()) {
    const auto fail = [&](const std::string& reason) {
      throw Failure(file.string() + ":" + std::to_string(lines.number()) + ": " + reason);
    };
    if (result == Result::kTooLong) fail("too long for a message");
    if (lines.line().empty()) continue;
    const message::RecordedLine line = message::parse_recorded_line(lines.line());
    if (const auto* error = std::get_if<message::RequestError>(&line)) {
      if (result == Result::kLine) fail(error->text);
    } else if (const auto* reading = std::get_if<message::OdometryReading>(&line)) {
      readings.push_back(*reading);
    }
  }
  if (readings.empty()) throw Failure(file.string() + ": not one ODOMETRY line in it");
  return readings;
}

}  // namespace cornerd::tool
