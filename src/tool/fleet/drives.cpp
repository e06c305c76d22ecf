// SPDX-License-Identifier: MIT
#include "tool/fleet/drives.hpp"

#include <cstdlib>

#include "mqtt/drive_parts.hpp"
#include "tool/command_line/failure.hpp"
#include "tool/command_line/output.hpp"

namespace cornerd::tool {

namespace {

constexpr std::chrono::seconds kDriveSilence{2};

}  // namespace

FleetDrives::FleetDrives(const BrokerOptions& options, const std::string& robot) {
  mqtt::DriveParts parts(options.site(), robot);
  mqtt::Broker broker(options.broker());
  broker.subscribe(parts.filter());
  wait_for_connection(broker);
  take_until_silent(broker, kDriveSilence,
                    [&](const mqtt::Message& message) { parts.take(message); });
  if (const auto names = parts.incomplete(); !names.empty()) {
    throw Failure("drive " + settings::one_line(names.front()) + " of robot " + robot +
                  " is not whole, or damaged: send it again");
  }
  const auto drives = parts.whole();
  if (drives.empty()) throw Failure("robot " + robot + " has sent no drive: cornerctl send-drive");
  std::string name = (std::filesystem::temp_directory_path() / "cornerctl-XXXXXX").native();
  if (::mkdtemp(name.data()) == nullptr) throw Failure(name + ": cannot be made");
  folder_ = name;
  for (std::size_t i = 0; i < drives.size(); ++i) {
    // A name of the network is no file name; its suffix says what it is.
    const bool is_bytes = drives[i].name.ends_with(".bin");
    files_.push_back(folder_ / (std::to_string(i) + (is_bytes ? ".bin" : ".ndjson")));
    write_file(files_.back(), drives[i].bytes);
  }
}

FleetDrives::~FleetDrives() {
  std::error_code ignored;
  std::filesystem::remove_all(folder_, ignored);
}

}  // namespace cornerd::tool
