// SPDX-License-Identifier: MIT
#include "tool/command_line/progress_bar.hpp"

#include <unistd.h>

#include <cstdio>
#include <utility>

namespace cornerd::tool {

ProgressBar::ProgressBar(std::string title, std::size_t total)
    : title_(std::move(title)), total_(total), on_terminal_(isatty(STDERR_FILENO) == 1) {}

ProgressBar::~ProgressBar() {
  if (on_terminal_ && shown_percent_ <= 100) std::fputs("\r\033[K", stderr);
}

void ProgressBar::show(std::size_t done, std::string_view phase) {
  if (!on_terminal_ || total_ == 0) return;
  const std::size_t percent = 100 * done / total_;
  if (percent == shown_percent_ && phase == shown_phase_) return;
  shown_percent_ = percent;
  shown_phase_ = phase;
  constexpr std::size_t kWidth = 40;
  const std::string bar(kWidth * done / total_, '#');
  std::fprintf(stderr, "\r%s [%-40s] %3zu %% %s\033[K", title_.c_str(), bar.c_str(), percent,
               shown_phase_.c_str());
}

}  // namespace cornerd::tool
