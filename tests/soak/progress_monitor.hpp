// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>

namespace cornerd::soak {

/// What this process has had of the machine.
struct Activity {
  double time_s = 0;           ///< on a clock that never stops
  double cpu_s = 0;            ///< of all its threads so far
  bool others_asleep = false;  ///< none of the other threads runs or waits for a processor

  static Activity now();
};

/// How long the program goes without progress, in time that it had: what it computes, and what it
/// sleeps. What it waits for a processor is the machine's doing, however long.
class ProgressMonitor {
 public:
  explicit ProgressMonitor(const Activity& start) : last_(start) {}

  void update(const Activity& now, bool has_progressed) {
    // Asleep now and before, and nothing done between: asleep all the time.
    const bool slept = last_.others_asleep && now.others_asleep;
    stalled_s_ += slept ? now.time_s - last_.time_s : now.cpu_s - last_.cpu_s;
    max_stalled_s_ = std::max(max_stalled_s_, stalled_s_);
    if (has_progressed) stalled_s_ = 0;
    last_ = now;
  }

  double stalled_s() const { return stalled_s_; }
  double max_stalled_s() const { return max_stalled_s_; }

 private:
  Activity last_;
  double stalled_s_ = 0;
  double max_stalled_s_ = 0;
};

}  // namespace cornerd::soak
