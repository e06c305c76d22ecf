// SPDX-License-Identifier: MIT
#include "replay/recording.hpp"

#include <array>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <span>
#include <utility>
#include <variant>

#include "drivers/make_driver.hpp"
#include "drivers/stream/sample_stream.hpp"
#include "replay/line_reader.hpp"

namespace cornerd::replay {
namespace {

constexpr std::size_t kBlockBytes = 4096;

std::ifstream open_for_reading(const std::filesystem::path& file) {
  const auto fail = [&](const std::string& reason) {
    throw RecordingError(file.string() + ": " + reason);
  };
  std::error_code ignored;
  if (std::filesystem::is_directory(file, ignored)) fail("is a folder; name a recording");
  if (file.extension() == ".gz") fail("is compressed; unpack it first (gunzip)");
  std::ifstream stream(file, std::ios::binary);
  if (!stream) fail(std::string("cannot be read: ") + std::strerror(errno));
  return stream;
}

RecordingKind kind_of(const std::filesystem::path& file, std::istream& stream) {
  if (file.extension() == ".bin") return RecordingKind::kBytes;
  if (file.extension() == ".ndjson") return RecordingKind::kMessages;
  return stream.peek() == '{' ? RecordingKind::kMessages : RecordingKind::kBytes;
}

/// Passes samples on and stores their time.
class TimeTap : public drivers::SampleSink {
 public:
  TimeTap(drivers::SampleSink& sink, core::TimeNs& time_ns) : sink_(sink), time_ns_(time_ns) {}
  void on_sample(const core::Sample& sample) override {
    time_ns_ = sample.t_ns;
    sink_.on_sample(sample);
  }
  void on_gap() override { sink_.on_gap(); }

 private:
  drivers::SampleSink& sink_;
  core::TimeNs& time_ns_;
};

}  // namespace

RecordingKind kind_of_recording(const std::filesystem::path& file) {
  std::ifstream stream = open_for_reading(file);
  return kind_of(file, stream);
}

class RecordingPlayer::Implementation {
 public:
  Implementation(const std::filesystem::path& file, const RecordingOptions& options)
      : name_(file.string()),
        file_(open_for_reading(file)),
        stream_(file_),
        kind_(kind_of(file, file_)),
        lines_(file_, message::kMaxRecordedBytes),
        samples_(make_stream(options)) {}

  Implementation(std::istream& stream, RecordingKind kind, const RecordingOptions& options)
      : name_("recording"),
        stream_(stream),
        kind_(kind),
        lines_(stream, message::kMaxRecordedBytes),
        samples_(make_stream(options)) {}

  bool step(RecordingSink& sink) {
    if (ended_) return false;
    const bool more = kind_ == RecordingKind::kBytes ? step_bytes(sink) : step_line(sink);
    if (stream_.bad()) throw RecordingError(name_ + ": read error; check the disk");
    if (more) return true;
    ended_ = true;
    if (input_ != Input::kScans) {
      TimeTap tap(sink, time_ns_);
      samples_->finish(tap);
    }
    return false;
  }

  core::TimeNs time_ns() const { return time_ns_; }
  const drivers::StreamCounters& counters() const {
    return input_ == Input::kScans ? scan_counters_ : samples_->counters();
  }
  std::uint64_t bad_lines() const { return bad_lines_; }
  const std::string& first_problem() const { return first_problem_; }

 private:
  enum class Input : std::uint8_t { kUnknown, kBytes, kScans };

  /// Reads the first block of a .bin whose lidar is not known.
  std::unique_ptr<drivers::SampleStream> make_stream(const RecordingOptions& options) {
    std::optional<drivers::DriverKind> driver = options.wire.driver;
    if (!driver && !options.wire.format && kind_ == RecordingKind::kBytes) {
      read_block();
      driver = drivers::detect_driver(block());
    }
    return std::make_unique<drivers::SampleStream>(
        drivers::make_decoder(driver.value_or(drivers::DriverKind::kRplidar), options.wire.format),
        drivers::StreamConfig{.inverted = options.inverted});
  }

  void read_block() {
    stream_.read(block_.data(), kBlockBytes);
    block_size_ = static_cast<std::size_t>(stream_.gcount());
  }
  std::span<const std::uint8_t> block() const {
    return {reinterpret_cast<const std::uint8_t*>(block_.data()), block_size_};
  }

  bool step_bytes(RecordingSink& sink) {
    if (block_size_ == 0) read_block();
    if (block_size_ == 0) return false;
    TimeTap tap(sink, time_ns_);
    samples_->feed_untimed(block(), tap);
    block_size_ = 0;
    return true;
  }

  bool step_line(RecordingSink& sink) {
    const LineReader::Result result = lines_.next();
    if (result == LineReader::Result::kEnd) return false;
    if (result == LineReader::Result::kTooLong) {
      note_problem("too long for a message");
      return true;
    }
    if (lines_.line().empty()) return true;
    message::RecordedLine line = message::parse_recorded_line(lines_.line());
    if (const auto* error = std::get_if<message::RequestError>(&line)) {
      if (result == LineReader::Result::kLine) note_problem(error->text);
    } else if (auto* scan = std::get_if<message::RecordedScan>(&line)) {
      play(*scan, sink);
    } else if (const auto* bytes = std::get_if<message::RecordedBytes>(&line)) {
      play(*bytes, sink);
    } else if (const auto* reading = std::get_if<message::OdometryReading>(&line)) {
      time_ns_ = reading->t_ns;
      sink.on_odometry(*reading);
    }
    return true;
  }

  bool is_input(Input input) {
    if (input_ == Input::kUnknown) input_ = input;
    return input_ == input;
  }

  void play(message::RecordedScan& scan, RecordingSink& sink) {
    if (!is_input(Input::kScans) || scan.samples.empty()) return;
    scan.samples.front().starts_scan = true;
    scan.samples.back().ends_scan = true;
    for (const core::Sample& sample : scan.samples) sink.on_sample(sample);
    time_ns_ = scan.samples.back().t_ns;
    scan_counters_.samples += scan.samples.size();
    ++scan_counters_.scans;
  }

  void play(const message::RecordedBytes& bytes, RecordingSink& sink) {
    if (!bytes.received || !is_input(Input::kBytes)) return;
    samples_->feed(bytes.bytes, bytes.t_ns, sink);
    time_ns_ = bytes.t_ns;
  }

  void note_problem(const std::string& problem) {
    ++bad_lines_;
    if (!first_problem_.empty()) return;
    first_problem_ = name_ + ": line " + std::to_string(lines_.number()) + ": " + problem;
  }

  std::string name_;
  std::ifstream file_;
  std::istream& stream_;
  RecordingKind kind_;
  LineReader lines_;
  std::array<char, kBlockBytes> block_{};
  std::size_t block_size_ = 0;
  std::unique_ptr<drivers::SampleStream> samples_;
  Input input_ = Input::kUnknown;
  bool ended_ = false;
  core::TimeNs time_ns_ = 0;
  drivers::StreamCounters scan_counters_;
  std::uint64_t bad_lines_ = 0;
  std::string first_problem_;
};

RecordingPlayer::RecordingPlayer(const std::filesystem::path& file, const RecordingOptions& options)
    : implementation_(std::make_unique<Implementation>(file, options)) {}
RecordingPlayer::RecordingPlayer(std::istream& stream, RecordingKind kind,
                                 const RecordingOptions& options)
    : implementation_(std::make_unique<Implementation>(stream, kind, options)) {}
RecordingPlayer::~RecordingPlayer() = default;

bool RecordingPlayer::step(RecordingSink& sink) { return implementation_->step(sink); }
core::TimeNs RecordingPlayer::time_ns() const { return implementation_->time_ns(); }
const drivers::StreamCounters& RecordingPlayer::counters() const {
  return implementation_->counters();
}
std::uint64_t RecordingPlayer::bad_lines() const { return implementation_->bad_lines(); }
const std::string& RecordingPlayer::first_problem() const {
  return implementation_->first_problem();
}

}  // namespace cornerd::replay
