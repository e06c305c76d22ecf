// SPDX-License-Identifier: MIT
#include "replay/recording_writer.hpp"

#include <cerrno>
#include <cstring>
#include <string>

namespace cornerd::replay {
namespace {

[[noreturn]] void fail(const std::filesystem::path& file) {
  const bool is_full = errno == ENOSPC || errno == EDQUOT || errno == EFBIG;
  throw RecordingError(file.string() + ": cannot be written: " + std::strerror(errno) +
                       (is_full ? "" : "; check the folder and its rights"));
}

std::ofstream open_for_writing(const std::filesystem::path& file) {
  std::ofstream stream(file, std::ios::binary | std::ios::trunc);
  if (!stream) fail(file);
  return stream;
}

void write(std::ofstream& stream, std::string_view text, const std::filesystem::path& file) {
  stream.write(text.data(), static_cast<std::streamsize>(text.size()));
  if (!stream) fail(file);
}

void flush_or_fail(std::ofstream& stream, const std::filesystem::path& file) {
  if (!stream.flush()) fail(file);
}

bool same(const core::Pose2& a, const core::Pose2& b) {
  return a.x_m == b.x_m && a.y_m == b.y_m && a.theta_rad == b.theta_rad;
}

}  // namespace

RecordingWriter::RecordingWriter(const std::filesystem::path& file)
    : file_(file), has_lines_(has_lines(file)), stream_(open_for_writing(file)) {}

void RecordingWriter::put(std::string_view text) { write(stream_, text, file_); }

void RecordingWriter::received(core::TimeNs t_ns, std::span<const std::uint8_t> bytes) {
  if (bytes.empty()) return;
  if (has_lines_) {
    put(line_.serial(t_ns, message::LineWriter::Direction::kRx, bytes));
  } else {
    put({reinterpret_cast<const char*>(bytes.data()), bytes.size()});
  }
}

void RecordingWriter::sent(core::TimeNs t_ns, std::span<const std::uint8_t> bytes) {
  if (bytes.empty() || !has_lines_) return;
  put(line_.serial(t_ns, message::LineWriter::Direction::kTx, bytes));
}

void RecordingWriter::odometry(const core::OdometryReading& reading) {
  if (has_lines_) put(line_.odometry(reading));
}

void RecordingWriter::flush() { flush_or_fail(stream_, file_); }

TruthWriter::TruthWriter(const std::filesystem::path& file)
    : file_(file), stream_(open_for_writing(file)) {}

void TruthWriter::put(const Entry& entry) {
  write(stream_, line_.truth(entry.t_ns, entry.T_map_base), file_);
  written_ = entry.T_map_base;
}

void TruthWriter::add(core::TimeNs t_ns, const core::Pose2& T_map_base) {
  if (written_ && same(*written_, T_map_base)) {
    held_back_ = {t_ns, T_map_base};
    return;
  }
  if (held_back_) put(*held_back_);
  held_back_.reset();
  put({t_ns, T_map_base});
}

void TruthWriter::flush() {
  if (held_back_) put(*held_back_);
  held_back_.reset();
  flush_or_fail(stream_, file_);
}

}  // namespace cornerd::replay
