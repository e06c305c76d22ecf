// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>

namespace cornerd::soak {

/// Time and processor use of this process.
struct Activity {
  double time_s = 0;           ///< monotonic
  double cpu_s = 0;            ///< of all threads so far
  bool others_asleep = false;  ///< no other thread is runnable

  static Activity now();
};

/// Time without progress: computing plus sleeping. Waiting for a processor does not count, as a
/// loaded machine causes it.
class ProgressMonitor {
 public:
  explicit ProgressMonitor(const Activity& start) : last_(start) {}

  void update(const Activity& now, bool has_progressed) {
    // Asleep at both ends: asleep all the time.
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
