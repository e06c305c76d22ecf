// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <filesystem>

#include "tool/monitor/frame.hpp"
#include "tool/monitor/monitor_state.hpp"
#include "tool/monitor/screen.hpp"
#include "tool/monitor/signal_queue.hpp"
#include "tool/monitor/terminal.hpp"
#include "tool/watch/socket_client.hpp"

namespace cornerd::tool {

/// Shows what the daemon says on the terminal until somebody has seen enough. A daemon that goes,
/// or is not there yet, is waited for.
class Monitor {
 public:
  /// The scene's map outlives it. Throws Failure where standard output is no terminal.
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
  SignalQueue signals_;  // before the terminal, so that none of them leaves it as it is now
  Terminal terminal_;
  FrameEncoder encoder_;
  SocketClient daemon_;
  MonitorState state_;
  Clock::time_point next_try_;
  std::chrono::milliseconds retry_;
  Clock::time_point drawn_;
  bool is_changed_ = true;
  bool is_done_ = false;
};

/// What the environment tells of a terminal (TERM, NO_COLOR, LC_ALL, LC_CTYPE, LANG).
bool terminal_is_dumb();
bool terminal_has_unicode();
bool terminal_has_colours();

}  // namespace cornerd::tool
