// SPDX-License-Identifier: MIT
#include "replay/recording.hpp"

#include <array>
#include <cerrno>
#include <cstdio>
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
/// Times of different classes are less out of order.
constexpr core::TimeNs kMaxBack_ns = core::kNsPerSecond;
/// From so many lines on times tell that they stand still.
constexpr std::uint64_t kMinTimed = 16;

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

/// Times of lines that go on where the recorder's clock was set back.
class LineClock {
 public:
  /// By how much this line's time goes back, where that is a set clock; else 0.
  core::TimeNs observe(core::TimeNs t_ns) {
    ++lines_;
    if (lines_ > 1 && t_ns == last_ns_) ++repeats_;
    last_ns_ = t_ns;
    const bool is_first = lines_ == 1;
    const core::TimeNs back_ns = is_first ? 0 : newest_ns_ - (t_ns + shift_ns_);
    if (is_first || back_ns < 0) newest_ns_ = t_ns + shift_ns_;
    if (back_ns <= kMaxBack_ns) return 0;
    shift_ns_ += back_ns;
    return back_ns;
  }
  core::TimeNs shift_ns() const { return shift_ns_; }
  bool stands_still() const { return lines_ >= kMinTimed && repeats_ + 1 == lines_; }

 private:
  core::TimeNs newest_ns_ = 0;
  core::TimeNs last_ns_ = 0;  ///< as recorded
  core::TimeNs shift_ns_ = 0;
  std::uint64_t lines_ = 0;
  std::uint64_t repeats_ = 0;
};

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
    if (clock_.stands_still()) {
      clock_problem_ = name_ + ": t is the same in every line: record the time of each line";
    }
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
  const std::string& first_problem() const {
    return first_problem_.empty() ? clock_problem_ : first_problem_;
  }
  std::string report() const {
    std::string text;
    if (bad_lines_ > 0) {
      text = name_ + ": " + std::to_string(bad_lines_) +
             " lines skipped; the first: " + first_problem_ + '\n';
    }
    return clock_problem_.empty() ? text : text + clock_problem_ + '\n';
  }

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
      const bool is_cut = result == LineReader::Result::kTornLine;
      note_problem(is_cut ? "the last line is cut: the recording ends before its end"
                          : error->text);
      if (error->class_name == "ODOMETRY") sink.on_refused_odometry(*error);
    } else if (auto* scan = std::get_if<message::RecordedScan>(&line)) {
      play(*scan, sink);
    } else if (const auto* bytes = std::get_if<message::RecordedBytes>(&line)) {
      play(*bytes, sink);
    } else if (const auto* reading = std::get_if<message::OdometryReading>(&line)) {
      play(*reading, sink);
    }
    return true;
  }

  bool is_input(Input input) {
    if (input_ == Input::kUnknown) input_ = input;
    return input_ == input;
  }

  void play(message::RecordedScan& scan, RecordingSink& sink) {
    if (!is_input(Input::kScans) || scan.samples.empty()) return;
    observe_time(scan.t_ns);
    for (core::Sample& sample : scan.samples) sample.t_ns += clock_.shift_ns();
    scan.samples.front().starts_scan = true;
    scan.samples.back().ends_scan = true;
    for (const core::Sample& sample : scan.samples) sink.on_sample(sample);
    time_ns_ = scan.samples.back().t_ns;
    scan_counters_.samples += scan.samples.size();
    ++scan_counters_.scans;
  }

  void play(const message::RecordedBytes& bytes, RecordingSink& sink) {
    if (!bytes.received || !is_input(Input::kBytes)) return;
    observe_time(bytes.t_ns);
    time_ns_ = bytes.t_ns + clock_.shift_ns();
    samples_->feed(bytes.bytes, time_ns_, sink);
  }

  /// Its time is by the client's clock, which tells nothing of the recorder's.
  void play(message::OdometryReading reading, RecordingSink& sink) {
    time_ns_ = reading.t_ns += clock_.shift_ns();
    sink.on_odometry(reading);
  }

  void observe_time(core::TimeNs t_ns) {
    const core::TimeNs back_ns = clock_.observe(t_ns);
    if (back_ns == 0 || !clock_problem_.empty()) return;
    std::array<char, 32> seconds{};
    std::snprintf(seconds.data(), seconds.size(), "%.1f s", core::to_seconds(back_ns));
    clock_problem_ = name_ + ": line " + std::to_string(lines_.number()) + ": t goes back by " +
                     seconds.data() + ": the recorder's clock was set, or two recordings follow " +
                     "each other; times go on from the line before";
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
  LineClock clock_;
  std::string clock_problem_;  ///< the first
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
std::string RecordingPlayer::report() const { return implementation_->report(); }

}  // namespace cornerd::replay
