// SPDX-License-Identifier: MIT
// cornerctl record: what comes from a lidar's port, and in .ndjson what is sent to it, with times;
// or what a running daemon reads.
#include <atomic>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <utility>

#include "drivers/driver_clock.hpp"
#include "drivers/make_driver.hpp"
#include "drivers/serial/byte_stream.hpp"
#include "drivers/serial/serial_port.hpp"
#include "replay/recording_writer.hpp"
#include "tool/command_line/command.hpp"
#include "tool/command_line/failure.hpp"
#include "tool/command_line/output.hpp"
#include "tool/command_line/shared_options.hpp"
#include "tool/command_line/stop_signal.hpp"
#include "tool/commands.hpp"
#include "tool/record/board_odometry.hpp"
#include "tool/record/daemon_recording.hpp"

namespace cornerd::tool {

namespace {

using drivers::RecordingByteStream;

struct RecordOptions {
  SettingsOptions settings;
  std::filesystem::path output;
  double seconds = 0;
  bool from_daemon = false;
  std::filesystem::path socket;
  bool names_port = false;  ///< --device, --driver, --baud or --mode
};

/// Writes the bytes of the driver's thread; a full disk ends the recording, not the thread.
class Recorder {
 public:
  explicit Recorder(const std::filesystem::path& file) : writer_(file) {}

  void observe(RecordingByteStream::Direction direction, std::span<const std::uint8_t> bytes) {
    drivers::Clock& clock = drivers::system_clock();
    const core::TimeNs t_ns = clock.monotonic_ns() + clock.unix_offset_ns();
    const bool received = direction == RecordingByteStream::Direction::kReceived;
    write([&] { received ? writer_.received(t_ns, bytes) : writer_.sent(t_ns, bytes); });
  }
  /// Of another thread.
  void observe(const core::OdometryReading& reading) {
    write([&] { writer_.odometry(reading); });
  }
  bool has_lines() const { return writer_.has_lines(); }

  bool failed() const { return failed_; }
  /// After the driver's thread has ended. Throws what went wrong.
  void finish() {
    if (problem_) std::rethrow_exception(problem_);
    writer_.flush();
  }

 private:
  void write(const auto& put) {
    if (failed_) return;
    const std::scoped_lock lock(mutex_);
    try {
      put();
    } catch (...) {
      problem_ = std::current_exception();
      failed_ = true;
    }
  }

  std::mutex mutex_;
  replay::RecordingWriter writer_;
  std::exception_ptr problem_;
  std::atomic<bool> failed_ = false;
};

class NoSink : public drivers::SampleSink {
 public:
  void on_sample(const core::Sample&) override {}
  void on_gap() override {}
};

drivers::DeviceConfig device_config(const settings::LidarConfig& lidar) {
  if (lidar.driver == settings::DriverKind::kReplay) {
    throw UsageError("lidar.driver: \"replay\" has no port to record");
  }
  return {.driver = lidar.driver,
          .device = lidar.device.string(),
          .baud = lidar.baud,
          .mode = lidar.mode,
          .inverted = lidar.mount.inverted,
          .motor = lidar.motor};
}

void report_change(const drivers::LidarStatus& now, drivers::LidarStatus& reported) {
  if (now.state == reported.state && now.detail.view() == reported.detail.view()) return;
  reported = now;
  const std::string_view state = to_string(now.state);
  const std::string_view detail = now.detail.view();
  std::fprintf(stderr, "cornerctl: %.*s%s%.*s\n", static_cast<int>(state.size()), state.data(),
               detail.empty() ? "" : ": ", static_cast<int>(detail.size()), detail.data());
}

/// Beside the daemon, which keeps the port.
void record_daemon(const RecordOptions& options) {
  if (options.names_port) {
    throw UsageError("--from-daemon records what the daemon reads; give no port of a lidar");
  }
  if (!replay::RecordingWriter::has_lines(options.output)) {
    throw UsageError("--from-daemon writes messages: give a file *.ndjson");
  }
  guard_files(
      {.read = {options.settings.config_file()}, .written = {options.output}, .output = {}});
  record_from_daemon(
      options.socket.empty() ? options.settings.resolve_for_daemon().socket.pose : options.socket,
      options.output, options.seconds);
}

void record(RecordOptions& options) {
  if (options.from_daemon || !options.socket.empty()) return record_daemon(options);
  const settings::Config settings = options.settings.resolve(/*needs_map=*/false);
  const drivers::DeviceConfig config = device_config(settings.lidar);
  guard_files({.read = {config.device, options.settings.config_file()},
               .written = {options.output},
               .output = {}});

  // A driver waits for a port that is not there; a person who mistyped its name should not.
  const std::uint32_t baud =
      config.baud != 0 ? config.baud : drivers::baud_rates_of(config.driver).front();
  drivers::OpenResult first = drivers::open_serial_port(config.device, baud);
  if (!first.stream) throw Failure(first.message);

  keep_earlier(options.output);
  Recorder recorder(options.output);
  StopSignal stop_signal;
  const auto open_port = [&](std::uint32_t rate) -> drivers::OpenResult {
    drivers::OpenResult port =
        first.stream ? std::exchange(first, {}) : drivers::open_serial_port(config.device, rate);
    if (port.stream) {
      port.stream = std::make_unique<RecordingByteStream>(
          std::move(port.stream),
          [&](auto direction, auto bytes) { recorder.observe(direction, bytes); });
    }
    return port;
  };
  const auto driver = drivers::make_driver(config, open_port);

  drivers::LidarStatus reported;
  std::optional<std::uint64_t> readings;
  {
    NoSink sink;
    std::optional<BoardOdometry> odometry;
    if (settings.odometry.source == settings::OdometrySource::kKernel && recorder.has_lines()) {
      odometry.emplace(settings.odometry, [&](const auto& reading) { recorder.observe(reading); });
    }
    const std::jthread reader([&](const std::stop_token& stop) { driver->run(stop, sink); });
    const core::TimeNs began_ns = drivers::system_clock().monotonic_ns();
    const auto over = [&] {
      const core::TimeNs elapsed_ns = drivers::system_clock().monotonic_ns() - began_ns;
      return recorder.failed() ||
             (options.seconds > 0 && core::to_seconds(elapsed_ns) >= options.seconds);
    };
    while (!over() && !stop_signal.wait(std::chrono::milliseconds(50))) {
      report_change(driver->status(), reported);
    }
    if (odometry) readings = odometry->status().counters.readings;
  }
  recorder.finish();
  const drivers::StreamCounters counters = driver->status().counters;
  if (counters.samples == 0) throw Failure(config.device + ": sent not a single sample");
  std::fprintf(stderr, "%s: %llu bytes, %llu scans\n", options.output.c_str(),
               static_cast<unsigned long long>(counters.bytes),
               static_cast<unsigned long long>(counters.scans));
  if (readings) {
    std::fprintf(stderr, "%s: %llu readings of wheels and gyro\n", options.output.c_str(),
                 static_cast<unsigned long long>(*readings));
  }
}

}  // namespace

void add_record(Command& program) {
  Command command =
      program.add_subcommand("record", "record the bytes of a lidar, or a running daemon's input");
  const auto options = std::make_shared<RecordOptions>();
  const auto override_with = [options](const char* pointer) {
    return [options, pointer](const std::string& value) {
      options->settings.add_override(pointer + ("=" + value));
      options->names_port = true;
    };
  };
  command.add_option_function("--device", override_with("/lidar/device"), "port of the lidar")
      .type_name("DEV");
  command.add_option_function("--driver", override_with("/lidar/driver"), "rplidar, ld, ydlidar")
      .type_name("NAME");
  command.add_option_function("--baud", override_with("/advanced/lidar/baud"),
                              "its baud rate; default: found out");
  command.add_option_function("--mode", override_with("/advanced/lidar/mode"),
                              "auto, or a scan mode by name");
  options->settings.add_config(command, kDaemonsConfig);
  command
      .add_option(
          "-o,--output", options->output,
          "the recording: .bin received bytes; .ndjson both directions with times, and wheels and "
          "gyro if odometry.source is kernel; a file of that name becomes FILE~")
      .required()
      .type_name("FILE");
  command.add_flag(
      "--from-daemon", options->from_daemon,
      "record beside a running daemon, from its socket: scans, wheels and gyro as they "
      "come, for replay; .ndjson");
  command
      .add_option("--socket", options->socket,
                  "the same, of this daemon; default: the pose socket of the config")
      .type_name("PATH");
  command.add_option("--seconds", options->seconds, "duration; default: until interrupted")
      .positive()
      .type_name("N");
  command.callback([options] { record(*options); });
}

}  // namespace cornerd::tool
