// SPDX-License-Identifier: MIT
#include "drivers/stream/stream_driver.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "drivers/stream/hint.hpp"
#include "drivers/stream/sample_stream.hpp"

namespace cornerd::drivers {
namespace {

using std::chrono::milliseconds;

// Retry of a port that is absent or busy: cheap, and finds a lidar at once when it is plugged in.
constexpr milliseconds kPortInterval{200};
constexpr milliseconds kFirstBackoff{100};
constexpr milliseconds kMaxBackoff{2000};
constexpr milliseconds kReadSlice{100};  // longest delay of a stop, and between progress counts
// A head that spins up sends nothing before its speed is stable.
constexpr core::TimeNs kSpinUpLimitNs = 6 * core::kNsPerSecond;
constexpr core::TimeNs kStallNs = core::kNsPerSecond;
constexpr core::TimeNs kSilenceLimitNs = 3 * core::kNsPerSecond;
// Bytes without a packet for so long are another speed, or another device. A packet takes 20 ms at
// most, but a line that is switched on in the middle of a revolution may wait for its first.
constexpr core::TimeNs kNoiseLimitNs = core::kNsPerSecond / 2;
constexpr core::TimeNs kNoiseAfterRunNs = core::kNsPerSecond;

/// Stops the device however a session ends.
class Shutdown {
 public:
  Shutdown(StreamProtocol& protocol, ByteStream& port) : protocol_(protocol), port_(port) {}
  ~Shutdown() { protocol_.stop(port_); }
  Shutdown(const Shutdown&) = delete;
  Shutdown& operator=(const Shutdown&) = delete;

 private:
  StreamProtocol& protocol_;
  ByteStream& port_;
};

}  // namespace

struct StreamDriver::Session {
  explicit Session(core::TimeNs now_ns) : last_sample_ns(now_ns), last_byte_ns(now_ns) {}

  core::TimeNs last_sample_ns;
  core::TimeNs last_byte_ns;
  bool has_received = false;
  core::TimeNs noise_since_ns = 0;  ///< 0: no byte since the last sample
};

StreamDriver::StreamDriver(StreamDriverConfig config, std::unique_ptr<StreamProtocol> protocol,
                           PortOpener open_port, Clock& clock)
    : config_(std::move(config)),
      rates_(config_.baud_rates),
      protocol_(std::move(protocol)),
      open_port_(std::move(open_port)),
      clock_(clock) {
  if (open_port_) return;
  open_port_ = [this](std::uint32_t rate) { return open_serial_port(config_.device, rate); };
}

void StreamDriver::run(std::stop_token stop, SampleSink& sink) {
  milliseconds backoff = kFirstBackoff;
  while (!stop.stop_requested()) {
    OpenResult opened = open_port_(rates_.current());
    count_progress();
    if (!opened.stream) {
      const auto [state, fault] = failure_of(opened.error);
      report(state, fault, opened.message);
      wait(kPortInterval, stop);
      continue;
    }
    has_run_ = false;
    Failure failure = session(*opened.stream, stop, sink);
    opened.stream.reset();
    if (has_run_) {
      backoff = kFirstBackoff;
      sink.on_gap();
    }
    if (stop.stop_requested()) break;
    if (failure.fault == LidarFault::kWrongBaud || failure.fault == LidarFault::kNoAnswer) {
      const auto fault = rates_.fail(failure.fault);
      if (!fault) continue;
      failure.fault = *fault;
    }
    report(failure.state, failure.fault, failure.extra);
    wait(backoff, stop);
    backoff = std::min(2 * backoff, kMaxBackoff);
  }
  board_.set_state(LidarState::kAbsent, LidarFault::kNone, config_.device + ": closed");
}

StreamDriver::Failure StreamDriver::session(ByteStream& opened, const std::stop_token& stop,
                                            SampleSink& sink) {
  MonitoredByteStream port(opened, [this] { count_progress(); });
  const Shutdown shutdown(*protocol_, port);
  board_.set_state(LidarState::kIdentifying, LidarFault::kNone,
                   config_.device + ": looking for " + described());
  const auto device = protocol_->start(port, clock_, stop);
  if (!device) return {LidarState::kBackoff, LidarFault::kNoAnswer, described()};
  board_.set_health(device->health);
  has_answered_ = device->received_bytes > 0;
  // One that sends by itself is what it should be as soon as it measures.
  board_.set_device(has_answered_ ? device->model : "", device->firmware, device->serial);
  board_.count_answers(device->received_bytes, device->used_bytes);
  if (device->failed) return {LidarState::kFaulty, LidarFault::kHealthError, device->health};
  board_.set_state(LidarState::kStarting, LidarFault::kNone,
                   config_.device + ": waiting for the motor");
  return measure(port, *device, stop, sink);
}

StreamDriver::Failure StreamDriver::measure(ByteStream& port, const StreamProtocol::Device& device,
                                            const std::stop_token& stop, SampleSink& sink) {
  SampleStream stream(protocol_->make_decoder(), {.inverted = config_.inverted,
                                                  .sample_period_s = device.sample_period_s,
                                                  .baud = rates_.current()});
  SampleMonitor monitor(sink, board_);
  board_.begin_stream();
  Failure failure;
  std::array<std::uint8_t, 2048> buffer;  // more than the fastest lidar sends meanwhile
  Session session(clock_.monotonic_ns());
  while (!stop.stop_requested()) {
    port.collect_for(monitor.collecting_time(clock_.monotonic_ns()));
    const auto [status, count] = port.read(buffer, kReadSlice);
    const core::TimeNs now_ns = clock_.monotonic_ns();
    if (status == ByteStream::ReadStatus::kLost) break;
    const std::uint64_t samples = stream.samples();
    stream.feed(std::span(buffer).first(count), now_ns, monitor,
                /*more_pending=*/count == buffer.size());
    board_.update(stream.counters(), stream.latency(), now_ns);
    const bool measured = stream.samples() > samples;
    if (measured && !has_run_) board_.set_device(device.model, device.firmware, device.serial);
    has_run_ = has_run_ || measured;
    if (const auto found = judge(session, now_ns, count > 0, measured)) {
      failure = *found;
      break;
    }
    if (!measured) continue;
    const LidarFault fault = monitor.fault();
    const bool is_faulty = fault != LidarFault::kNone;
    const LidarState state = is_faulty ? LidarState::kFaulty : LidarState::kRunning;
    if (board_.state() == state && board_.fault() == fault) continue;
    is_faulty ? report(state, fault) : board_.set_state(state, fault, "");
  }
  board_.end_stream(stream.counters());
  return failure;
}

/// The failure that ends the session; a stall is only reported, as the head may resume.
std::optional<StreamDriver::Failure> StreamDriver::judge(Session& session, core::TimeNs now_ns,
                                                         bool received, bool measured) {
  session.has_received = session.has_received || received;
  if (received) session.last_byte_ns = now_ns;
  if (measured) {
    session.last_sample_ns = now_ns;
    session.noise_since_ns = 0;
    return std::nullopt;
  }
  if (received && session.noise_since_ns == 0) session.noise_since_ns = now_ns;
  const core::TimeNs noise_ns =
      session.noise_since_ns == 0 ? 0 : session.last_byte_ns - session.noise_since_ns;
  if (noise_ns > (has_run_ ? kNoiseAfterRunNs : kNoiseLimitNs)) {
    if (has_run_) return Failure{LidarState::kBackoff, LidarFault::kUnexpectedData};
    return Failure{LidarState::kBackoff, LidarFault::kWrongBaud,
                   "bytes that are not of " + described() + " baud"};
  }
  const core::TimeNs silent_ns = now_ns - session.last_byte_ns;
  if (silent_ns > (has_run_ ? kSilenceLimitNs : kSpinUpLimitNs)) {
    if (has_run_) return Failure{LidarState::kBackoff, LidarFault::kMotorStalled};
    // Silence of one that sends by itself: it may be another lidar.
    return Failure{LidarState::kBackoff, LidarFault::kNoData,
                   has_answered_ ? std::string() : suspicions(session.has_received)};
  }
  if (has_run_ && silent_ns > kStallNs) report(LidarState::kFaulty, LidarFault::kMotorStalled);
  return std::nullopt;
}

std::string StreamDriver::suspicions(bool has_received) const {
  return std::string(has_received ? "" : "why not a byte comes (is its TX at the RX here?), ") +
         "that it is " + described() + " baud (if not, set lidar.driver), and ";
}

std::string StreamDriver::described() const {
  return std::string(protocol_->name()) + " at " + rates_.text();
}

void StreamDriver::wait(milliseconds duration, const std::stop_token& stop) {
  for (; duration.count() > 0 && !stop.stop_requested(); duration -= kReadSlice) {
    clock_.wait(std::min(duration, kReadSlice), stop);
    count_progress();
  }
}

void StreamDriver::report(LidarState state, LidarFault fault, std::string_view extra) {
  const std::string text = hint(fault, config_.device, extra);
  if (board_.state() == state && board_.fault() == fault && board_.detail() == text) return;
  board_.set_state(state, fault, text);
}

}  // namespace cornerd::drivers
