// SPDX-License-Identifier: MIT
#include "tool/monitor/monitor.hpp"

#include <poll.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <csignal>
#include <cstdlib>
#include <string>
#include <string_view>
#include <utility>

namespace cornerd::tool {

namespace {

using namespace std::chrono_literals;

constexpr std::string_view kWatch =
    "{\"class\":\"WATCH\",\"classes\":[\"POSE\",\"SCAN\",\"BREAKPOINTS\",\"STATUS\",\"EVENT\"]}\n";
/// Faster than an A1's scan rate, slow enough for a serial terminal.
constexpr auto kMinFrameInterval = 100ms;
/// Keeps the ages on the screen up to date while no message comes.
constexpr auto kMaxFrameInterval = 500ms;
constexpr int kMaxZoom = 8;

std::string environment(const char* name) {
  const char* const value = std::getenv(name);
  return value == nullptr ? "" : value;
}

core::TimeNs nanoseconds(std::chrono::steady_clock::time_point time) {
  return std::chrono::nanoseconds(time.time_since_epoch()).count();
}

}  // namespace

Monitor::Monitor(std::filesystem::path socket, const Scene& scene, const ViewChoice& choice,
                 bool colours)
    : socket_(std::move(socket)),
      scene_(scene),
      choice_(choice),
      signals_({SIGINT, SIGTERM, SIGHUP, SIGQUIT, SIGWINCH, SIGTSTP, SIGCONT}),
      encoder_(colours),
      next_try_(Clock::now()),
      drawn_(Clock::now() - kMaxFrameInterval) {}

void Monitor::run() {
  while (!is_done_) {
    connect_when_due();
    draw_when_due();
    wait();
  }
}

void Monitor::connect_when_due() {
  const Clock::time_point now = Clock::now();
  if (state_.is_connected() || now < next_try_) return;
  if (daemon_.connect(socket_, /*blocking=*/false) && daemon_.send(kWatch)) {
    state_.connect(nanoseconds(now));
    is_changed_ = true;
    return;
  }
  lose_daemon(daemon_.problem());
}

void Monitor::lose_daemon(std::string_view reason) {
  // Backs off here and not at connect(), so that a daemon that accepts and exits is covered too.
  next_try_ = Clock::now() + retry_.next();
  state_.lose(reason, nanoseconds(Clock::now()));
  daemon_.close();
  is_changed_ = true;
}

void Monitor::draw_when_due() {
  const Clock::time_point now = Clock::now();
  const auto since = now - drawn_;
  if (terminal_.has_unsent() || since < kMinFrameInterval) return;
  if (!is_changed_ && since < kMaxFrameInterval) return;
  const Terminal::Size size = terminal_.size();
  const Frame frame =
      draw_screen(state_, scene_, choice_, size.columns, size.rows, nanoseconds(now));
  if (!terminal_.show(encoder_.encode(frame))) is_done_ = true;
  drawn_ = now;
  is_changed_ = false;
}

void Monitor::wait() {
  if (is_done_) return;
  Clock::time_point until = drawn_ + (is_changed_ ? kMinFrameInterval : kMaxFrameInterval);
  if (!state_.is_connected()) until = std::min(until, next_try_);
  const auto left = std::chrono::ceil<std::chrono::milliseconds>(until - Clock::now());
  // Nothing can be drawn while the terminal accepts no output.
  const int timeout_ms = terminal_.has_unsent() ? static_cast<int>(kMaxFrameInterval / 1ms)
                                                : std::max(0, static_cast<int>(left.count()));
  const short keys_and_room =
      static_cast<short>(terminal_.has_unsent() ? POLLIN | POLLOUT : POLLIN);
  std::array<pollfd, 3> waited = {pollfd{signals_.fd(), POLLIN, 0},
                                  pollfd{terminal_.fd(), keys_and_room, 0},
                                  pollfd{daemon_.fd(), POLLIN, 0}};
  if (::poll(waited.data(), waited.size(), timeout_ms) <= 0) return;
  if (waited[0].revents != 0) handle_signals();
  if (waited[1].revents & POLLOUT && !terminal_.flush()) is_done_ = true;
  if (waited[1].revents & ~POLLOUT) handle_keys();
  if (waited[2].revents != 0) listen();
}

void Monitor::listen() {
  std::string_view line;
  client::Received received;
  while ((received = daemon_.take(line)) == client::Received::kLine) {
    state_.take_line(line, nanoseconds(Clock::now()));
    is_changed_ = true;
  }
  if (state_.status()) retry_.reset();
  if (received == client::Received::kEnd) {
    lose_daemon(socket_.string() + ": the daemon closed the connection");
  }
}

void Monitor::handle_keys() {
  const auto keys = terminal_.take_keys();
  if (!keys) {
    is_done_ = true;
    return;
  }
  for (const char key : *keys) {
    is_changed_ = true;
    if (key == 'q' || key == 'Q') is_done_ = true;
    if (key == 'a') choice_.unicode = !choice_.unicode;
    if (key == 'l') choice_.lidar_view = !choice_.lidar_view;
    if (key == '+' || key == '=') choice_.zoom = std::min(choice_.zoom + 1, kMaxZoom);
    if (key == '-') choice_.zoom = std::max(choice_.zoom - 1, 0);
  }
}

void Monitor::handle_signals() {
  for (int signal = 0; (signal = signals_.take()) != 0;) {
    is_changed_ = true;
    if (signal == SIGTSTP) {
      suspend();
    } else if (signal == SIGCONT) {
      // Other programs may have changed the terminal meanwhile.
      terminal_.enter();
      encoder_.forget();
    } else if (signal == SIGWINCH) {
      encoder_.forget();
    } else {
      is_done_ = true;
    }
  }
}

void Monitor::suspend() {
  terminal_.leave();
  std::raise(SIGSTOP);
}

bool terminal_is_dumb() { return environment("TERM") == "dumb"; }

bool terminal_has_unicode() {
  const std::string term = environment("TERM");
  // The Linux console has 512 characters, none of them Braille.
  if (term == "linux" || term.starts_with("vt")) return false;
  for (const char* name : {"LC_ALL", "LC_CTYPE", "LANG"}) {
    std::string value = environment(name);
    if (value.empty()) continue;
    std::transform(value.begin(), value.end(), value.begin(),
                   [](unsigned char c) { return std::tolower(c); });
    return value.find("utf-8") != std::string::npos || value.find("utf8") != std::string::npos;
  }
  return false;
}

bool terminal_has_colours() {
  const std::string term = environment("TERM");
  return environment("NO_COLOR").empty() && !term.empty() && !term.starts_with("vt");
}

}  // namespace cornerd::tool
