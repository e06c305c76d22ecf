// SPDX-License-Identifier: MIT
// cornerctl send-drive: a recording to the robot's site, for `cornerctl survey --broker`.
#include <memory>
#include <string>

#include "mqtt/config.hpp"
#include "mqtt/drive_parts.hpp"
#include "settings/document.hpp"
#include "tool/command_line/command.hpp"
#include "tool/command_line/failure.hpp"
#include "tool/commands.hpp"
#include "tool/fleet/broker_options.hpp"

namespace cornerd::tool {

namespace {

struct SendOptions {
  std::filesystem::path file;
  std::string robot;
  BrokerOptions broker;
};

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
