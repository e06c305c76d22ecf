// SPDX-License-Identifier: MIT
// cornerctl send-drive: a recording to the robot's site, for `cornerctl survey --broker`.
#include <algorithm>
#include <filesystem>
#include <memory>
#include <string>

#include "mqtt/config.hpp"
#include "mqtt/drive_parts.hpp"
#include "replay/recording.hpp"
#include "settings/document.hpp"
#include "tool/command_line/command.hpp"
#include "tool/command_line/failure.hpp"
#include "tool/command_line/shared_options.hpp"
#include "tool/commands.hpp"
#include "tool/fleet/broker_options.hpp"

namespace cornerd::tool {

namespace {

struct SendOptions {
  std::filesystem::path file;
  std::string robot;
  BrokerOptions broker;
};

/// Plays until the second scan begins.
class FirstScan final : public replay::RecordingSink {
 public:
  void on_sample(const core::Sample& sample) override { starts_ += sample.starts_scan ? 1 : 0; }
  void on_gap() override {}
  void on_odometry(const message::OdometryReading& /*reading*/) override {}
  bool is_whole() const { return starts_ > 1; }

 private:
  int starts_ = 0;
};

bool has_scan(const std::filesystem::path& file, const drivers::RecordedWire& wire) {
  FirstScan scan;
  replay::RecordingPlayer player(file, {wire, false});
  while (!scan.is_whole() && player.step(scan)) {
  }
  // Other bytes are a measurement by chance, here and there.
  const drivers::StreamCounters& counters = player.counters();
  return scan.is_whole() && counters.used_bytes >= counters.bytes / 2;
}

/// The site gets what a survey can read.
void require_drive(const std::filesystem::path& file) {
  const bool is_bytes = replay::kind_of_recording(file) == replay::RecordingKind::kBytes;
  if (is_bytes && file.extension() != ".bin") {
    throw Failure(file.string() +
                  ": is no drive (.ndjson), nor are a port's bytes named so (.bin)");
  }
  if (has_scan(file, {})) return;
  const auto is_of = [&](const NamedWire& known) { return has_scan(file, known.wire); };
  if (is_bytes && std::ranges::any_of(known_wires(), is_of)) return;
  throw Failure(file.string() +
                ": has no whole scan of a lidar, so is no drive: send what cornerctl record makes");
}

void send(const SendOptions& options) {
  const std::string name = options.file.filename();
  for (const std::string& level : {name, options.robot}) {
    if (!mqtt::is_topic_level(level)) {
      throw UsageError("\"" + level + "\" is no level of a topic: choose another name");
    }
  }
  const std::string bytes =
      settings::read_file(options.file, mqtt::kMaxDriveBytes, settings::FileKind::kOrdinary);
  if (bytes.empty()) throw Failure(options.file.string() + ": is empty");
  require_drive(options.file);
  mqtt::Broker broker(options.broker.broker());
  wait_for_connection(broker);
  for (const mqtt::Message& message :
       mqtt::drive_messages(options.broker.site(), options.robot, name, bytes)) {
    publish_retained(broker, message.topic, message.payload);
  }
}

}  // namespace

void add_send_drive(Command& program) {
  Command command =
      program.add_subcommand("send-drive", "a recording to the robot's site, for its survey");
  const auto options = std::make_shared<SendOptions>();
  command.add_option("file", options->file, "a recording, at most 64 MiB")
      .required()
      .type_name("FILE");
  command.add_option("--robot", options->robot, "the robot's serial number")
      .required()
      .type_name("SERIAL");
  options->broker.add(command);
  command.callback([options] { send(*options); });
}

}  // namespace cornerd::tool
