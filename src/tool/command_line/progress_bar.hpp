// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace cornerd::tool {

/// Progress of a long command, a line on standard error; not shown if that is no terminal.
class ProgressBar {
 public:
  ProgressBar(std::string title, std::size_t total);
  ~ProgressBar();  ///< erases the line
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  /// `phase`: the current step.
  void show(std::size_t done, std::string_view phase = {});

 private:
  std::string title_;
  std::size_t total_;
  bool on_terminal_;
  std::size_t shown_percent_ = 101;
  std::string shown_phase_;
};

}  // namespace cornerd::tool
