// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <filesystem>

#include "client/connection.hpp"
#include "client/retry_delay.hpp"
#include "tool/monitor/frame.hpp"
#include "tool/monitor/monitor_state.hpp"
#include "tool/monitor/screen.hpp"
#include "tool/monitor/signal_queue.hpp"
#include "tool/monitor/terminal.hpp"

namespace cornerd::tool {

/// Shows the daemon's messages on the terminal. Reconnects to a daemon that is absent or exits.
class Monitor {
 public:
  /// The scene's map must outlive the monitor. Throws Failure if standard output is no terminal.
  Monitor(std::filesystem::path socket, const Scene& scene, const ViewChoice& choice, bool colours);

  /// Until key q, an interrupt, a request to end, or the end of the terminal.
  void run();

 private:
  using Clock = std::chrono::steady_clock;

  void connect_when_due();
  void lose_daemon(std::string_view reason);
  /// Sleeps until there is something to do.
  void wait();
  void listen();
  void handle_keys();
  void handle_signals();
  void suspend();
  void draw_when_due();

  std::filesystem::path socket_;
  Scene scene_;
  ViewChoice choice_;
  SignalQueue signals_;  // before the terminal: a signal must not prevent its restoration
  Terminal terminal_;
  FrameEncoder encoder_;
  client::Connection daemon_;
  MonitorState state_;
  Clock::time_point next_try_;
  client::RetryDelay retry_{std::chrono::seconds(2)};
  Clock::time_point drawn_;
  bool is_changed_ = true;
  bool is_done_ = false;
};

/// Properties of the terminal by TERM, NO_COLOR, LC_ALL, LC_CTYPE and LANG.
bool terminal_is_dumb();
bool terminal_has_unicode();
bool terminal_has_colours();

}  // namespace cornerd::tool
