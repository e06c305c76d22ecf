// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>

namespace cornerd::core {

/// What a robot did in a step.
struct Motion {
  double way_m = 0;
  double rotation_rad = 0;
  double duration_s = 0;
};

/// The motion of the last steps, smoothed: about that of the next one, with none of the noise of
/// its counts, of its rate and of its time.
class UsualMotion {
 public:
  void add(const Motion& step) {
    if (usual_.duration_s <= 0 || is_unusual(step.duration_s)) {
      usual_ = step;
      return;
    }
    const double share = std::min(1.0, step.duration_s / kLately_s);
    usual_.way_m += share * (step.way_m - usual_.way_m);
    usual_.rotation_rad += share * (step.rotation_rad - usual_.rotation_rad);
    usual_.duration_s += share * (step.duration_s - usual_.duration_s);
  }
  void forget() { usual_ = {}; }

  /// What the step that is to come should be: `itself` where the ones before do not tell.
  const Motion& of(const Motion& itself) const {
    return usual_.duration_s <= 0 || is_unusual(itself.duration_s) ? itself : usual_;
  }

 private:
  static constexpr double kLately_s = 0.1;
  /// Longer or shorter by more than this factor, and other readings are missing or new.
  static constexpr double kUnusual = 1.8;

  bool is_unusual(double duration_s) const {
    return duration_s > kUnusual * usual_.duration_s || usual_.duration_s > kUnusual * duration_s;
  }

  Motion usual_;
};

}  // namespace cornerd::core
