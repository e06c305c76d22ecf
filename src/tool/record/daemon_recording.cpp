// SPDX-License-Identifier: MIT
#include "tool/record/daemon_recording.hpp"

#include <charconv>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <string>
#include <string_view>
#include <variant>

#include "client/subscription.hpp"
#include "message/request.hpp"
#include "tool/command_line/failure.hpp"
#include "tool/command_line/output.hpp"
#include "tool/command_line/stop_signal.hpp"

namespace cornerd::tool {

namespace {

using Clock = std::chrono::steady_clock;

/// How soon a signal or the end of the time is noticed.
constexpr std::chrono::milliseconds kPollTime{50};

/// Lines that the daemon dropped before this one, because they were not read in time.
std::uint64_t dropped_before(std::string_view line) {
  constexpr std::string_view kKey = "\"dropped\":";
  std::uint64_t count = 0;
  if (const std::size_t at = line.find(kKey); at != std::string_view::npos) {
    std::from_chars(line.data() + at + kKey.size(), line.data() + line.size(), count);
  }
  return count;
}

struct Recorded {
  unsigned long long scans = 0;
  unsigned long long readings = 0;
  unsigned long long dropped = 0;
};

void keep(std::string_view line, Output& output, Recorded& recorded) {
  const message::RecordedLine parsed = message::parse_recorded_line(line);
  const bool is_scan = std::holds_alternative<message::RecordedScan>(parsed);
  if (!is_scan && !std::holds_alternative<message::OdometryReading>(parsed)) return;
  ++(is_scan ? recorded.scans : recorded.readings);
  recorded.dropped += dropped_before(line);
  output.write(line);
  output.write("\n");
}

}  // namespace

void record_from_daemon(const std::filesystem::path& socket, const std::filesystem::path& file,
                        double seconds) {
  client::Subscription daemon(socket, client::watch_request("SCAN,ODOMETRY"));
  std::string_view line;
  if (daemon.wait(line) == client::Event::kLost) {
    throw Failure(daemon.problem() + " (does cornerd run?)");
  }
  keep_earlier(file);
  Output output(file);
  const StopSignal stop_signal;
  Recorded recorded;
  const Clock::time_point end = Clock::now() + std::chrono::duration_cast<Clock::duration>(
                                                   std::chrono::duration<double>(seconds));
  while (!stop_signal.wait(std::chrono::nanoseconds(0)) && (seconds == 0 || Clock::now() < end)) {
    switch (daemon.wait(line, kPollTime)) {
      case client::Event::kMessage:
        keep(line, output, recorded);
        break;
      case client::Event::kLost:
        std::fprintf(stderr, "cornerctl: %s; waiting for it\n", daemon.problem().c_str());
        break;
      case client::Event::kConnected:
        std::fputs("cornerctl: the daemon is back\n", stderr);
        break;
      case client::Event::kTimeout:
        break;
    }
  }
  output.flush();
  if (recorded.scans + recorded.readings == 0) {
    throw Failure(socket.string() + ": neither SCAN nor ODOMETRY came; cornerctl doctor says why");
  }
  std::fprintf(stderr, "%s: %llu scans, %llu readings of wheels and gyro\n", file.c_str(),
               recorded.scans, recorded.readings);
  if (recorded.dropped > 0) {
    std::fprintf(stderr,
                 "cornerctl: %llu messages are missing: the machine was too busy to read them\n",
                 recorded.dropped);
  }
}

}  // namespace cornerd::tool
