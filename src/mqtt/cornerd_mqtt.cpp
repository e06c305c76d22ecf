// SPDX-License-Identifier: MIT
#include "mqtt/cornerd_mqtt.hpp"

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <string>
#include <utility>

#include "mqtt/bridge.hpp"
#include "mqtt/broker.hpp"
#include "mqtt/control_queue.hpp"
#include "tool/command_line/command.hpp"
#include "tool/command_line/failure.hpp"
#include "tool/command_line/stop_signal.hpp"

namespace cornerd::mqtt {

namespace {

/// How long a message of the broker waits at most: poses come at 7 a second.
constexpr std::chrono::milliseconds kTick{50};
/// The daemon restarts in less than a second.
constexpr std::chrono::milliseconds kLargestRetryDelay{500};
constexpr std::chrono::seconds kStopTime{2};

Bridge::Now now() {
  const std::chrono::duration<double> steady = std::chrono::steady_clock::now().time_since_epoch();
  return {steady.count(), std::chrono::system_clock::now()};
}

/// Says each change of the connection once.
class ConnectionLog {
 public:
  void note(const Broker& broker) {
    std::string text =
        broker.is_connected() ? "connected to the broker" : "no broker: " + broker.problem();
    if (!broker.refusal().empty()) text += ", which refuses messages: " + broker.refusal();
    if (text == told_) return;
    std::fprintf(stderr, "cornerd-mqtt: %s\n", text.c_str());
    told_ = std::move(text);
  }

 private:
  std::string told_;
};

void run(const std::filesystem::path& file, bool is_check) {
  const BridgeConfig config = load_bridge_config(file);
  if (is_check) {
    std::puts("ok");
    return;
  }
  const tool::StopSignal stop;  // before any thread
  Message will{Vda5050(config).topic("connection"),
               Vda5050(config).connection(Vda5050::Connection::kBroken, now().unix_time)};
  ControlQueue control(config.socket.control);
  Broker broker(config.broker, std::move(will));
  Bridge bridge(config, broker, [&control](std::string line, ControlQueue::Done done) {
    return control.ask(std::move(line), std::move(done));
  });
  client::Subscription daemon(config.socket.pose, client::watch_request("VERSION,POSE,STATUS,MAP"),
                              kLargestRetryDelay);
  ConnectionLog log;
  while (!stop.wait(std::chrono::nanoseconds(0))) {
    std::string_view line;
    const client::Event event = daemon.wait(line, kTick);
    bridge.on_daemon(
        event, event == client::Event::kMessage ? line : std::string_view(daemon.problem()), now());
    for (const Message& message : broker.take()) bridge.on_broker(message);
    control.deliver();
    bridge.tick(now());
    log.note(broker);
  }
  bridge.say_goodbye(now());
  // Resolving a name, or connecting to a machine that does not answer, cannot be interrupted.
  if (!broker.stop(kStopTime)) std::_Exit(tool::kExitDone);
}

}  // namespace

int run_cornerd_mqtt(int argc, const char* const* argv) {
  const auto add = [](tool::Command& program) {
    struct Options {
      std::filesystem::path config;
      bool is_check = false;
    };
    const auto options = std::make_shared<Options>();
    program.add_option("--config", options->config, "JSON with // comments")
        .required()
        .type_name("FILE");
    program.add_flag("--check", options->is_check, "read the config, say what is wrong, or \"ok\"");
    program.callback([options] { run(options->config, options->is_check); });
  };
  return tool::run_program("cornerd-mqtt", "speaks for one robot to its fleet: VDA 5050 over MQTT",
                           add, argc, argv);
}

}  // namespace cornerd::mqtt
