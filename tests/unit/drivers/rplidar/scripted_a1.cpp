// SPDX-License-Identifier: MIT
#include "scripted_a1.hpp"

#include <algorithm>

#include "drivers/rplidar/protocol/framing.hpp"

namespace cornerd::rplidar::test {
namespace {

using std::chrono::milliseconds;
using std::chrono::nanoseconds;

constexpr core::TimeNs kCapsuleNs = 32 * 254'000;

/// Removes all returns from a capsule.
void make_blind(Bytes& capsule) {
  std::fill(capsule.begin() + 4, capsule.end(), std::uint8_t{0});
  std::uint8_t checksum = 0;
  for (std::size_t i = 2; i < capsule.size(); ++i) checksum ^= capsule[i];
  capsule[0] = static_cast<std::uint8_t>(0xA0 | (checksum & 15));
  capsule[1] = static_cast<std::uint8_t>(0x50 | checksum >> 4);
}

class ScriptedPort : public drivers::ByteStream {
 public:
  explicit ScriptedPort(ScriptedA1& device) : device_(device) {}

  ReadResult read(std::span<std::uint8_t> buffer, milliseconds timeout) override {
    if (device_.unplugged()) return {ReadStatus::kLost, 0};
    if (device_.output.empty() && device_.scanning) send_capsule();
    const core::TimeNs ready_ns = device_.output_from_ns;
    const core::TimeNs limit_ns = device_.clock.now_ns + nanoseconds(timeout).count();
    if (device_.output.empty() || ready_ns > limit_ns) {
      device_.clock.advance(timeout);
      return {};
    }
    if (ready_ns > device_.clock.now_ns) {
      device_.clock.advance(nanoseconds(ready_ns - device_.clock.now_ns));
    }
    const std::size_t count = std::min(buffer.size(), device_.output.size());
    std::copy_n(device_.output.begin(), count, buffer.begin());
    device_.output.erase(device_.output.begin(),
                         device_.output.begin() + static_cast<std::ptrdiff_t>(count));
    device_.read_bytes += count;
    return {ReadStatus::kData, count};
  }

  bool write(std::span<const std::uint8_t> bytes) override {
    if (device_.unplugged()) return false;
    for (const std::uint8_t byte : bytes) {
      if (const auto request = parser_.add(byte)) device_.receive(*request);
    }
    return true;
  }

  void discard_input() override { device_.output.clear(); }

  bool set_dtr(bool asserted) override {
    device_.motor_runs = !asserted;
    return true;
  }

 private:
  void send_capsule() {
    if (!device_.measures || !device_.motor_runs) return;
    device_.output_from_ns = std::max(device_.output_from_ns, device_.clock.now_ns) + kCapsuleNs;
    const int c = device_.capsule++;
    Bytes capsule = express_capsules(c + 1, 5, 21.4).back();
    if (device_.blind) make_blind(capsule);
    device_.output.insert(device_.output.end(), capsule.begin(), capsule.end());
  }

  ScriptedA1& device_;
  RequestParser parser_;
};

}  // namespace

drivers::OpenResult ScriptedA1::open(std::uint32_t at_baud) {
  ++opened;
  understood = baud == 0 || at_baud == baud;
  if (unplugged()) return {nullptr, drivers::OpenError::kAbsent, "/dev/lidar: no such port"};
  if (open_error != drivers::OpenError::kNone) {
    return {nullptr, open_error, "/dev/lidar: held by another process"};
  }
  motor_runs = false;  // the kernel asserts DTR on open
  output.insert(output.end(), chatter.begin(), chatter.end());
  return {std::make_unique<ScriptedPort>(*this), drivers::OpenError::kNone, {}};
}

void ScriptedA1::receive(const Request& request) {
  if (!understood) return;
  requests.push_back(request);
  scanning = false;
  switch (request.command()) {
    case Command::kReset: {
      ++resets;
      if (resets >= resets_to_measure && resets_to_measure > 0) measures = true;
      if (health.size() > 1) health.pop_front();
      output.clear();
      const std::string banner = "RP LIDAR System.\r\nFirmware Ver 1.29 - rtm\r\nModel: 18\r\n";
      output.insert(output.end(), banner.begin(), banner.end());
      output_from_ns = clock.now_ns + nanoseconds(milliseconds(671)).count();
      break;
    }
    case Command::kGetInfo: {
      const auto payload = info.encode();
      answer(0x04, Bytes(payload.begin(), payload.end()));
      break;
    }
    case Command::kGetHealth: {
      const auto payload = health.front().encode();
      answer(0x06, Bytes(payload.begin(), payload.end()));
      break;
    }
    case Command::kGetSampleRate:
      if (info.firmware >= firmware_version(1, 17)) {
        answer(0x15,
               {0xF4, 0x01, static_cast<std::uint8_t>(wrong_periods-- > 0 ? 0x7A : 0xFA), 0x00});
      }
      break;
    case Command::kGetConf:
      answer_conf(request);
      break;
    case Command::kScan:
    case Command::kExpressScan: {
      scanning = answers;
      capsule = 0;
      if (answers)
        output.insert(output.end(), kExpressDescriptor.begin(), kExpressDescriptor.end());
      break;
    }
    default:
      break;
  }
}

void ScriptedA1::answer(std::uint8_t type, const Bytes& payload) {
  if (noise) output.insert(output.end(), 20, std::uint8_t{0xE7});
  if (!answers || lost_answers-- > 0) return;
  const auto head =
      Descriptor{.size = static_cast<std::uint32_t>(payload.size()), .stream = false, .type = type}
          .encode();
  output.insert(output.end(), head.begin(), head.end());
  output.insert(output.end(), payload.begin(), payload.end());
}

void ScriptedA1::answer_conf(const Request& request) {
  if (info.series() < 4 && info.firmware < firmware_version(1, 24)) return;
  const auto query = ConfQuery::decode(request.payload());
  Bytes payload(request.payload().begin(), request.payload().begin() + 4);
  const auto add = [&](std::initializer_list<int> bytes) {
    for (const int byte : bytes) payload.push_back(static_cast<std::uint8_t>(byte));
  };
  const std::size_t mode = query->mode.value_or(0);
  constexpr std::array<int, 5> kAnswers{0x81, 0x82, 0x84, 0x84, 0x84};
  constexpr std::array<int, 5> kPeriodsUs{508, 254, 127, 127, 201};
  if (mode >= mode_names.size()) return;
  switch (static_cast<ConfType>(query->type)) {
    case ConfType::kTypicalMode:
      add({1, 0});
      break;
    case ConfType::kModeCount:
      if (!counts_modes) return;
      add({static_cast<int>(mode_names.size()), 0});
      break;
    case ConfType::kAnswerType:
      add({kAnswers[mode]});
      break;
    case ConfType::kModePeriod:
      add({0, kPeriodsUs[mode] & 0xFF, kPeriodsUs[mode] >> 8, 0});
      if (mode == 1 && wrong_periods-- > 0) payload[5] ^= 0x20;
      break;
    case ConfType::kModeName:
      payload.insert(payload.end(), mode_names[mode].begin(), mode_names[mode].end());
      add({0});
      break;
    default:
      return;
  }
  answer(0x20, payload);
}

std::vector<std::string> names(const std::vector<Request>& requests) {
  std::vector<std::string> names;
  for (const Request& request : requests) {
    switch (request.command()) {
      case Command::kStop:
        names.emplace_back("STOP");
        break;
      case Command::kReset:
        names.emplace_back("RESET");
        break;
      case Command::kGetInfo:
        names.emplace_back("INFO");
        break;
      case Command::kGetHealth:
        names.emplace_back("HEALTH");
        break;
      case Command::kGetSampleRate:
        names.emplace_back("RATE");
        break;
      case Command::kScan:
        names.emplace_back("SCAN");
        break;
      case Command::kExpressScan:
        names.emplace_back("EXPRESS " + std::to_string(request.payload()[0]));
        break;
      default:
        names.emplace_back("CONF");
    }
  }
  return names;
}

}  // namespace cornerd::rplidar::test
