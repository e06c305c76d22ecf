// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>

namespace cornerd::soak {

/// What this process has had of the machine.
struct Activity {
  double time_s = 0;       ///< on a clock that never stops
  double cpu_s = 0;        ///< of all its threads so far
  bool is_asleep = false;  ///< none of the other threads runs or waits for a processor

  static Activity now();
};

/// How long the program goes without progress, in time that it had: what it computes, and what it
/// sleeps. What it waits for a processor is the machine's doing, however long.
class ProgressWatch {
 public:
  explicit ProgressWatch(const Activity& start) : last_(start) {}

  void look(const Activity& now, bool has_progressed) {
    // Asleep now and before, and nothing done between: asleep all the time.
    const bool slept = last_.is_asleep && now.is_asleep;
    still_s_ += slept ? now.time_s - last_.time_s : now.cpu_s - last_.cpu_s;
    longest_s_ = std::max(longest_s_, still_s_);
    if (has_progressed) still_s_ = 0;
    last_ = now;
  }

  double still_s() const { return still_s_; }
  double longest_s() const { return longest_s_; }

 private:
  Activity last_;
  double still_s_ = 0;
  double longest_s_ = 0;
};

}  // namespace cornerd::soak
