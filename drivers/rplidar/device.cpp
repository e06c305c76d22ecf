// SPDX-License-Identifier: MIT
#include "drivers/rplidar/device.hpp"

#include <algorithm>

namespace cornerd::rplidar {
namespace {

using std::chrono::milliseconds;

// Each limit and the failure that it answers.
constexpr milliseconds kAnswerTimeout{500};  // a request lost on the way, or sent too early
constexpr milliseconds kQuiet{20};           // a scan in flight, a banner: neither pauses so long
constexpr milliseconds kPause{40};           // between two capsules, through a USB adapter
constexpr milliseconds kListenLimit{100};    // a scan in flight: six capsules at least
constexpr milliseconds kDrainLimit{500};     // a device that does not stop talking
constexpr milliseconds kBootLimit{1500};     // a banner that never comes; real ones take 671 ms
constexpr milliseconds kSlice{100};          // a stop that is asked for while nothing comes

constexpr std::uint16_t kFirmwareWithConf = firmware_version(1, 24);
constexpr std::uint16_t kFirmwareWithExpress = firmware_version(1, 17);
constexpr std::uint32_t kMaxModes = 16;
constexpr int kTriesToAgree = 4;

/// What two answers on end say. No checksum guards them, and a period with one bit wrong makes
/// every time stamp wrong that follows.
auto confirmed(const auto& ask) {
  auto before = ask();
  for (int attempt = 1; attempt < kTriesToAgree && before; ++attempt) {
    auto answer = ask();
    if (answer == before) return answer;
    before = answer;
  }
  return decltype(before)(std::nullopt);
}

}  // namespace

void Device::listen(MeasurementSearch& search) {
  search_ = &search;
  read_until_quiet(kPause, kListenLimit, false);
  search_ = nullptr;
}

bool Device::quiet() {
  if (!send(Request(Command::kStop))) return false;
  read_until_quiet(kQuiet, kDrainLimit, false);
  if (heard_banner_) wait_while_it_boots();
  return !lost_;
}

bool Device::reset() {
  if (!send(Request(Command::kReset))) return false;
  read_until_quiet(kQuiet, kBootLimit, true);
  heard_banner_ = false;
  return !lost_;
}

std::optional<DeviceInfo> Device::info(int tries) {
  for (int attempt = 0; attempt < tries && !lost_; ++attempt) {
    const auto answer = ask(Request(Command::kGetInfo), AnswerType::kInfo);
    if (answer) return DeviceInfo::decode(*answer);
  }
  return std::nullopt;
}

std::optional<Health> Device::health() {
  const auto answer = ask(Request(Command::kGetHealth), AnswerType::kHealth);
  return answer ? Health::decode(*answer) : std::nullopt;
}

std::vector<ScanMode> Device::modes(const DeviceInfo& info) {
  std::vector<ScanMode> modes;
  if (info.firmware >= kFirmwareWithConf) {
    const auto count = ask_conf(ConfType::kModeCount);
    const std::uint32_t number = count ? count->number(2).value_or(0) : 0;
    for (std::uint32_t id = 0; id < std::min(number, kMaxModes) && !lost_; ++id) {
      if (auto mode = conf_mode(static_cast<std::uint16_t>(id))) modes.push_back(std::move(*mode));
    }
    if (!modes.empty()) return modes;
  }
  modes.push_back({.id = 0, .name = "Standard", .format = WireFormat::kStandard, .period_s = 0});
  if (info.firmware >= kFirmwareWithExpress) {
    const auto ask_rate = [this] {
      const auto answer = ask(Request(Command::kGetSampleRate), AnswerType::kSampleRate);
      return answer ? SampleRate::decode(*answer) : std::nullopt;
    };
    if (const auto rate = confirmed(ask_rate)) {
      modes.front().period_s = rate->standard_us * 1e-6;
      modes.push_back({.id = 0,
                       .name = "Express",
                       .format = WireFormat::kExpress,
                       .period_s = rate->express_us * 1e-6});
    }
  }
  return modes;
}

std::optional<ScanMode> Device::conf_mode(std::uint16_t id) {
  ScanMode mode{.id = id, .name = {}, .format = WireFormat::kStandard, .period_s = 0};
  const auto type = ask_conf(ConfType::kAnswerType, id);
  const auto type_byte = type ? type->number(1) : std::nullopt;
  const auto format = type_byte ? wire_format(static_cast<AnswerType>(*type_byte)) : std::nullopt;
  if (!format) return std::nullopt;
  mode.format = *format;
  const auto ask_period = [this, id] {
    const auto answer = ask_conf(ConfType::kModePeriod, id);
    return answer ? answer->number(4) : std::nullopt;
  };
  mode.period_s = confirmed(ask_period).value_or(0) / 256.0 * 1e-6;
  if (const auto name = ask_conf(ConfType::kModeName, id)) mode.name = name->text();
  return mode;
}

std::optional<ConfAnswer> Device::ask_conf(ConfType type, std::optional<std::uint16_t> mode) {
  const auto answer =
      ask(Request::get_conf(static_cast<std::uint32_t>(type), mode), AnswerType::kGetConf);
  const auto conf = answer ? ConfAnswer::decode(*answer) : std::nullopt;
  return conf && conf->is(type) ? conf : std::nullopt;
}

std::optional<Device::Answer> Device::ask(const Request& request, AnswerType type) {
  if (!send(request)) return std::nullopt;
  const core::TimeNs deadline_ns =
      clock_.monotonic_ns() + std::chrono::nanoseconds(kAnswerTimeout).count();
  DescriptorSearch search;
  std::optional<Descriptor> descriptor;
  std::size_t received = 0;
  while (!stop_.stop_requested() && clock_.monotonic_ns() < deadline_ns) {
    const auto result = read(kSlice);
    if (lost_) return std::nullopt;
    if (heard_banner_) {
      // What was asked before it had started was not heard.
      wait_while_it_boots();
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

void Device::wait_while_it_boots() {
  heard_banner_ = false;
  booted_ = true;
  read_until_quiet(kQuiet, kDrainLimit, false);
}

bool Device::send(const Request& request) {
  if (!lost_) lost_ = !port_.write(request.bytes());
  return !lost_;
}

void Device::read_until_quiet(Milliseconds quiet, Milliseconds limit, bool wait_for_first) {
  const core::TimeNs deadline_ns = clock_.monotonic_ns() + std::chrono::nanoseconds(limit).count();
  bool any = !wait_for_first;
  while (!stop_.stop_requested() && clock_.monotonic_ns() < deadline_ns) {
    const auto result = read(any ? quiet : kSlice);
    if (lost_) return;
    if (result.count > 0) any = true;
    if (any && result.count == 0) return;
  }
}

drivers::ByteStream::ReadResult Device::read(Milliseconds timeout) {
  const auto result = port_.read(buffer_, timeout);
  lost_ = lost_ || result.status == drivers::ByteStream::ReadStatus::kLost;
  heard_bytes_ += result.count;
  const auto bytes = std::span(buffer_).first(result.count);
  if (banner_.add(bytes)) heard_banner_ = true;
  if (search_ != nullptr) search_->add(bytes);
  return result;
}

}  // namespace cornerd::rplidar
