// SPDX-License-Identifier: MIT
#include "replay/emulator/emulator.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "replay/emulator/firmware.hpp"
#include "replay/simulator/wire_encoder.hpp"

namespace cornerd::replay {
namespace {

using rplidar::AnswerType;
using rplidar::Command;

/// All bytes of a request must arrive within this time.
constexpr core::TimeNs kRequestTimeoutNs = 5 * core::kNsPerSecond;
/// From the end of a request to the first bit of its answer. Real round trips take 2.3 to 4.5 ms
/// for answers of 1.3 to 2.3 ms.
constexpr core::TimeNs kAnswerDelayNs = 1'000'000;
/// From RESET to the banner, and from there to the first request that is answered; measured on an
/// A1M8 of firmware 1.29.
constexpr core::TimeNs kBootNs = 671'000'000;
/// An S1 sends nothing and takes no request for 2 s, as users report.
constexpr core::TimeNs kSilentBootNs = 2 * core::kNsPerSecond;
constexpr core::TimeNs kIgnoreAfterBannerNs = 4'000'000;
/// If the caller stalls for longer, the stream restarts.
constexpr core::TimeNs kMaxStallNs = core::kNsPerSecond;

}  // namespace

Emulator::Emulator(const EmulatorConfig& config, std::unique_ptr<PacketSource> source)
    : config_(config),
      source_(std::move(source)),
      transmitter_(config.baud),
      health_(config.health),
      motor_runs_(config.firmware->motor != MotorRequests::kPwm) {}

void Emulator::receive(std::span<const std::uint8_t> bytes, core::TimeNs now_ns) {
  measure_until(now_ns);
  for (const std::uint8_t byte : bytes) {
    if (now_ns < ignores_until_ns_) {
      parser_.reset();
      continue;
    }
    if (now_ns - request_begun_ns_ > kRequestTimeoutNs) parser_.reset();
    if (!parser_.in_request()) request_begun_ns_ = now_ns;
    if (const auto request = parser_.add(byte)) handle(*request, now_ns);
  }
}

void Emulator::handle(const rplidar::Request& request, core::TimeNs now_ns) {
  const Firmware& firmware = *config_.firmware;
  switch (request.command()) {
    case Command::kScan:
    case Command::kForceScan:
      start_scan(standard_mode(firmware), request.command() == Command::kForceScan, now_ns);
      break;
    case Command::kExpressScan:
      if (request.payload().size() != 5) break;
      if (const auto mode = express_mode(firmware, request.payload()[0])) {
        start_scan(*mode, false, now_ns);
      }
      break;
    case Command::kStop:
      stop_scan(now_ns);
      break;
    case Command::kReset:
      reset(now_ns);
      break;
    case Command::kGetInfo:
      answer(now_ns, AnswerType::kInfo,
             rplidar::DeviceInfo{firmware.model,
                                 rplidar::firmware_version(firmware.major, firmware.minor),
                                 firmware.hardware, config_.serial}
                 .encode());
      break;
    case Command::kGetHealth:
      answer(now_ns, AnswerType::kHealth, health_.encode());
      break;
    case Command::kGetSampleRate:
      answer(now_ns, AnswerType::kSampleRate,
             rplidar::SampleRate{firmware.standard_us, firmware.express_us}.encode());
      break;
    case Command::kGetConf:
      answer_configuration(request.payload(), now_ns);
      break;
    case Command::kGetAccessoryBoard:
      if (firmware.motor == MotorRequests::kPwm) {
        answer(now_ns, AnswerType::kAccessoryBoard, std::array<std::uint8_t, 4>{1});
      }
      break;
    case Command::kSetMotorPwm:
    case Command::kSetMotorSpeed: {
      const auto wanted =
          firmware.motor == MotorRequests::kPwm ? Command::kSetMotorPwm : Command::kSetMotorSpeed;
      if (firmware.motor == MotorRequests::kNone || request.command() != wanted) break;
      if (request.payload().size() != 2) break;
      set_motor((request.payload()[0] | request.payload()[1]) != 0, now_ns);
      break;
    }
    default:
      break;
  }
}

void Emulator::set_motor(bool runs, core::TimeNs now_ns) {
  const bool was_still = is_still();
  motor_runs_ = runs;
  if (was_still && !is_still() && scanning_) begin_stream(now_ns);
}

void Emulator::answer(core::TimeNs now_ns, AnswerType type, std::span<const std::uint8_t> payload) {
  stop_scan(now_ns);
  const rplidar::Descriptor descriptor{static_cast<std::uint32_t>(payload.size()), false,
                                       static_cast<std::uint8_t>(type)};
  transmitter_.queue(now_ns + kAnswerDelayNs, descriptor.encode());
  transmitter_.queue(now_ns + kAnswerDelayNs, payload);
}

void Emulator::answer_configuration(std::span<const std::uint8_t> request, core::TimeNs now_ns) {
  const std::optional<RotationTarget> target =
      config_.answers_rotation_request ? std::optional(RotationTarget{}) : std::nullopt;
  const std::vector<std::uint8_t> value = configuration_value(*config_.firmware, target, request);
  if (!value.empty()) answer(now_ns, AnswerType::kGetConf, value);
}

void Emulator::start_scan(const FirmwareScanMode& mode, bool force, core::TimeNs now_ns) {
  if (health_.failed()) return;
  stop_scan(now_ns);
  if (config_.firmware->motor == MotorRequests::kSpeed) motor_runs_ = true;
  mode_ = mode;
  scanning_ = true;
  transmitter_.queue(now_ns + kAnswerDelayNs, scan_descriptor(mode.format));
  const core::TimeNs spin_up_ns = force ? 0 : core::from_seconds(config_.spin_up_s);
  begin_stream(now_ns + kAnswerDelayNs + spin_up_ns);
}

void Emulator::stop_scan(core::TimeNs now_ns) {
  if (!scanning_) return;
  scanning_ = false;
  transmitter_.drop_unsent(now_ns);
}

void Emulator::set_stalled(bool stalled, core::TimeNs now_ns) {
  measure_until(now_ns);
  const bool was_still = is_still();
  stalled_ = stalled;
  if (was_still && !is_still() && scanning_) begin_stream(now_ns);
}

void Emulator::set_health(const rplidar::Health& health, core::TimeNs now_ns) {
  health_ = health;
  if (health_.failed()) stop_scan(now_ns);
}

void Emulator::begin_stream(core::TimeNs now_ns) {
  source_->start(now_ns, mode_.format, core::TimeNs{mode_.period_q8_us} * 1000 / 256);
  prepare_packet();
}

void Emulator::reset(core::TimeNs now_ns) {
  scanning_ = false;
  parser_.reset();
  transmitter_.clear(now_ns);
  if (config_.reset_restores_health) health_ = {};
  const std::string_view banner = config_.firmware->banner;
  const std::vector<std::uint8_t> bytes(banner.begin(), banner.end());
  const core::TimeNs boot_ns = banner.empty() ? kSilentBootNs : kBootNs;
  transmitter_.queue(now_ns + boot_ns, bytes);
  ignores_until_ns_ =
      now_ns + boot_ns + SerialLine(config_.baud).duration_ns(bytes.size()) + kIgnoreAfterBannerNs;
}

void Emulator::prepare_packet() {
  const WirePacket packet = source_->next();
  packet_ready_ns_ = packet.ready_ns;
  if (!repeats_) packet_.assign(packet.bytes.begin(), packet.bytes.end());
}

void Emulator::measure_until(core::TimeNs now_ns) {
  if (is_still()) return;
  if (scanning_ && now_ns - packet_ready_ns_ > kMaxStallNs) begin_stream(now_ns);
  while (scanning_ && packet_ready_ns_ <= now_ns) {
    transmitter_.queue(packet_ready_ns_, packet_);
    prepare_packet();
  }
}

void Emulator::take(core::TimeNs now_ns, std::vector<std::uint8_t>& out) {
  measure_until(now_ns);
  transmitter_.take(now_ns, out);
}

std::optional<core::TimeNs> Emulator::next_ns() const {
  const std::optional<core::TimeNs> sending_ns = transmitter_.next_ns();
  if (!scanning_ || is_still()) return sending_ns;
  return std::min(packet_ready_ns_, sending_ns.value_or(packet_ready_ns_));
}

}  // namespace cornerd::replay
