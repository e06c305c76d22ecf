// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace cornerd::tool {

/// A line on standard error that says how far a long command is; nothing where that is no terminal.
class ProgressBar {
 public:
  ProgressBar(std::string title, std::size_t total);
  ~ProgressBar();  ///< takes the line away
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  /// `phase`: what is being done.
  void show(std::size_t done, std::string_view phase = {});

 private:
  std::string title_;
  std::size_t total_;
  bool on_terminal_;
  std::size_t shown_percent_ = 101;
  std::string shown_phase_;
};

}  // namespace cornerd::tool
