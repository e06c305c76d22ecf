// SPDX-License-Identifier: MIT
#include "drivers/rplidar/device.hpp"

#include <algorithm>
#include <array>

namespace cornerd::rplidar {
namespace {

using std::chrono::milliseconds;

// Each limit, and the failure it bounds.
constexpr milliseconds kAnswerTimeout{500};  // a request that was lost, or sent too early
constexpr milliseconds kIdle{20};            // pauses within a scan or a banner are shorter
constexpr milliseconds kPause{40};           // longest pause between capsules through a USB adapter
constexpr milliseconds kListenLimit{100};    // at least six capsules of a running scan
constexpr milliseconds kDrainLimit{500};     // a device that never stops sending
constexpr milliseconds kBootLimit{2000};  // an A1's banner takes 671 ms; an S1 prints none in 2 s
constexpr milliseconds kSlice{100};       // delay of a requested stop

constexpr std::uint16_t kFirmwareWithConf = firmware_version(1, 24);
constexpr std::uint16_t kFirmwareWithExpress = firmware_version(1, 17);
constexpr std::uint32_t kMaxModes = 16;
// The protocol's examples, for a device that has no answer.
constexpr std::uint16_t kDefaultPwm = 660;
constexpr std::uint16_t kDefaultRpm = 600;
constexpr int kMaxConfirmations = 4;

/// The value of two successive equal answers. Answers have no checksum, and one wrong bit in a
/// period falsifies every later time stamp.
auto confirmed(const auto& query) {
  auto before = query();
  for (int attempt = 1; attempt < kMaxConfirmations && before; ++attempt) {
    auto answer = query();
    if (answer == before) return answer;
    before = answer;
  }
  return decltype(before)(std::nullopt);
}

}  // namespace

void Device::listen(MeasurementSearch& search) {
  search_ = &search;
  read_until_idle(kPause, kListenLimit, false);
  search_ = nullptr;
}

bool Device::stop_scan() {
  if (!send(Request(Command::kStop))) return false;
  read_until_idle(kIdle, kDrainLimit, false);
  if (saw_banner_) wait_for_boot();
  return !lost_;
}

bool Device::reset() {
  if (!send(Request(Command::kReset))) return false;
  read_until_idle(kIdle, kBootLimit, true);
  saw_banner_ = false;
  return !lost_;
}

std::optional<DeviceInfo> Device::info(int tries) {
  for (int attempt = 0; attempt < tries && !lost_; ++attempt) {
    const auto answer = query(Request(Command::kGetInfo), AnswerType::kInfo);
    if (answer) return DeviceInfo::decode(*answer);
  }
  return std::nullopt;
}

std::optional<Health> Device::health() {
  const auto answer = query(Request(Command::kGetHealth), AnswerType::kHealth);
  return answer ? Health::decode(*answer) : std::nullopt;
}

std::vector<ScanMode> Device::modes(const DeviceInfo& info) {
  std::vector<ScanMode> modes;
  if (info.measures_time_of_flight() || info.firmware >= kFirmwareWithConf) {
    const auto count = query_conf(ConfType::kModeCount);
    std::uint32_t first = 0;
    std::uint32_t end = std::min(count ? count->number(2).value_or(0) : 0, kMaxModes);
    if (!count) {
      // The vendor's programs ask for the typical mode alone.
      const auto typical = query_conf(ConfType::kTypicalMode);
      first = typical ? typical->number(2).value_or(0) : 0;
      end = typical ? first + 1 : 0;
    }
    for (std::uint32_t id = first; id < end && !lost_; ++id) {
      if (auto mode = conf_mode(static_cast<std::uint16_t>(id))) modes.push_back(std::move(*mode));
    }
    if (!modes.empty()) return modes;
  }
  modes.push_back({.id = 0, .name = "Standard", .format = WireFormat::kStandard, .period_s = 0});
  if (!info.measures_time_of_flight() && info.firmware >= kFirmwareWithExpress) {
    const auto query_rate = [this] {
      const auto answer = query(Request(Command::kGetSampleRate), AnswerType::kSampleRate);
      return answer ? SampleRate::decode(*answer) : std::nullopt;
    };
    if (const auto rate = confirmed(query_rate)) {
      modes.front().period_s = rate->standard_us * 1e-6;
      modes.push_back({.id = 0,
                       .name = "Express",
                       .format = WireFormat::kExpress,
                       .period_s = rate->express_us * 1e-6});
    }
  }
  return modes;
}

std::optional<MotorRequest> Device::motor_request(const DeviceInfo& info) {
  constexpr int kFirstWithSpeed = 6;
  const int series = info.series();
  const bool may_have_board = series == 2 || series == 3;
  if (series < kFirstWithSpeed && !may_have_board) return std::nullopt;
  if (may_have_board) {
    const auto board = query(Request(Command::kGetAccessoryBoard, std::array<std::uint8_t, 4>{}),
                             AnswerType::kAccessoryBoard);
    const bool has_pwm = board && (board->front() & 1) != 0;
    if (!has_pwm) return std::nullopt;
  }
  const auto target = query_conf(ConfType::kDesiredRotation);
  const std::uint32_t both = target ? target->number(4).value_or(0) : 0;
  const auto rpm = static_cast<std::uint16_t>(both);
  const auto pwm = static_cast<std::uint16_t>(both >> 16);
  if (may_have_board) {
    return MotorRequest{Command::kSetMotorPwm, pwm != 0 ? pwm : kDefaultPwm};
  }
  return MotorRequest{Command::kSetMotorSpeed, rpm != 0 ? rpm : kDefaultRpm};
}

std::optional<ScanMode> Device::conf_mode(std::uint16_t id) {
  ScanMode mode{.id = id, .name = {}, .format = WireFormat::kStandard, .period_s = 0};
  const auto type = query_conf(ConfType::kAnswerType, id);
  const auto type_byte = type ? type->number(1) : std::nullopt;
  const auto format = type_byte ? wire_format(static_cast<AnswerType>(*type_byte)) : std::nullopt;
  if (!format) return std::nullopt;
  mode.format = *format;
  const auto query_period = [this, id] {
    const auto answer = query_conf(ConfType::kModePeriod, id);
    return answer ? answer->number(4) : std::nullopt;
  };
  mode.period_s = confirmed(query_period).value_or(0) / 256.0 * 1e-6;
  if (const auto name = query_conf(ConfType::kModeName, id)) mode.name = name->text();
  return mode;
}

std::optional<ConfAnswer> Device::query_conf(ConfType type, std::optional<std::uint16_t> mode) {
  const auto answer =
      query(Request::get_conf(static_cast<std::uint32_t>(type), mode), AnswerType::kGetConf);
  const auto conf = answer ? ConfAnswer::decode(*answer) : std::nullopt;
  return conf && conf->is(type) ? conf : std::nullopt;
}

std::optional<Device::Answer> Device::query(const Request& request, AnswerType type) {
  if (!send(request)) return std::nullopt;
  const core::TimeNs deadline_ns =
      clock_.monotonic_ns() + std::chrono::nanoseconds(kAnswerTimeout).count();
  DescriptorSearch search;
  std::optional<Descriptor> descriptor;
  std::size_t received = 0;
  while (!stop_.stop_requested() && clock_.monotonic_ns() < deadline_ns) {
    const auto result = read(kSlice);
    if (lost_) return std::nullopt;
    if (saw_banner_) {
      // A booting device ignored the request.
      wait_for_boot();
      return std::nullopt;
    }
    for (const std::uint8_t byte : std::span(buffer_).first(result.count)) {
      if (!descriptor) {
        const auto found = search.add(byte);
        const bool wanted = found && found->is(type) && !found->stream && found->size > 0 &&
                            found->size <= answer_.size();
        if (wanted) descriptor = found;
        continue;
      }
      answer_[received++] = byte;
      if (received < descriptor->size) continue;
      used_bytes_ += kDescriptorSize + received;
      return std::span(answer_).first(received);
    }
  }
  return std::nullopt;
}

void Device::wait_for_boot() {
  saw_banner_ = false;
  booted_ = true;
  read_until_idle(kIdle, kDrainLimit, false);
}

bool Device::send(const Request& request) {
  if (!lost_) lost_ = !port_.write(request.bytes());
  return !lost_;
}

void Device::read_until_idle(Milliseconds idle, Milliseconds limit, bool wait_for_first) {
  const core::TimeNs deadline_ns = clock_.monotonic_ns() + std::chrono::nanoseconds(limit).count();
  bool any = !wait_for_first;
  while (!stop_.stop_requested() && clock_.monotonic_ns() < deadline_ns) {
    const auto result = read(any ? idle : kSlice);
    if (lost_) return;
    if (result.count > 0) any = true;
    if (any && result.count == 0) return;
  }
}

drivers::ByteStream::ReadResult Device::read(Milliseconds timeout) {
  const auto result = port_.read(buffer_, timeout);
  lost_ = lost_ || result.status == drivers::ByteStream::ReadStatus::kLost;
  received_bytes_ += result.count;
  const auto bytes = std::span(buffer_).first(result.count);
  if (banner_.add(bytes)) saw_banner_ = true;
  if (search_ != nullptr) search_->add(bytes);
  return result;
}

}  // namespace cornerd::rplidar
