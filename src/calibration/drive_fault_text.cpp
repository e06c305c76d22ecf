// SPDX-License-Identifier: MIT
#include "calibration/drive_fault_text.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

namespace cornerd::calibration {
namespace {

/// A factor this near to an integer counts as the integer.
constexpr double kIntegerTolerance = 0.1;
/// A gyro of 2,000 degrees a second in 16 bits counts 939 a rad/s; degrees are 57.
constexpr double kRawGyroFactor = 300;

std::string number(const char* format, double value) {
  std::array<char, 48> text{};
  std::snprintf(text.data(), text.size(), format, value);
  return text.data();
}

class FaultText {
 public:
  explicit FaultText(const OdometryNames& names) : names_(names) {}

  std::string of(const DriveHypothesis& one) const {
    switch (one.fault) {
      case DriveFault::kNone:
        return {};
      case DriveFault::kWiring: {
        const std::string signs = of_wiring(one.wiring);
        return one.factor == 1 ? signs : signs + "; " + of_counts(one.factor);
      }
      case DriveFault::kCounts:
        return of_counts(one.factor);
      case DriveFault::kLeftCounts:
        return of_one_wheel("left", one.factor);
      case DriveFault::kRightCounts:
        return of_one_wheel("right", one.factor);
      case DriveFault::kTrack:
        return "the rotations match a track of " + number("%.3g m", one.track_m) +
               ": set odometry.track";
      case DriveFault::kLeftUnrelated:
        return of_unrelated("left", "right", one);
      case DriveFault::kRightUnrelated:
        return of_unrelated("right", "left", one);
      case DriveFault::kBothUnrelated:
        return one.is_silent
                   ? "neither wheel's counts change, or hardly, while the robot drives: check both "
                     "encoders, that counts are totals and no increments, and counts_per_turn"
                   : "wheels and lidar measure different motions, and no single fault "
                     "accounts for it: check wheel_radius, track, counts_per_turn, the signs "
                     "and times of the counts, and that lidar.mount is in metres";
      case DriveFault::kDelay:
        return of_delay(one.delay_s);
      case DriveFault::kMountTurned:
        return one.factor == 1 ? of_turn(one) : of_turn(one) + "; " + of_counts(one.factor);
      case DriveFault::kMountDisplaced:
        return of_place(one);
      case DriveFault::kMountBoth:
        return of_turn(one) + "; " + of_place(one);
    }
    return {};
  }

  std::string of(const GyroHypothesis& one) const {
    constexpr const char* kReversed =
        "the gyro's sign is reversed; a rotation to the left is "
        "positive: ";
    constexpr const char* kDegrees = "the gyro is in degrees a second: send radians a second";
    switch (one.fault) {
      case GyroFault::kNone:
        return {};
      case GyroFault::kReversed:
        return kReversed + reverse("gyro", names_.gyro_is_reversed);
      case GyroFault::kDegrees:
        return kDegrees;
      case GyroFault::kDegreesReversed:
        return kReversed + reverse("gyro", names_.gyro_is_reversed) + "; " + kDegrees;
      case GyroFault::kFactor:
        return "the gyro reads " + number("%.3g", one.factor) + " times the true rate" +
               (std::abs(one.factor) > kRawGyroFactor
                    ? ", as raw counts of a chip do, or millidegrees"
                    : "") +
               ": it has to be in radians a second";
      case GyroFault::kBias:
        return "the gyro reads " + number("%+.2f", one.bias_rad_s) +
               " rad/s while the robot stands: calibrate its zero before the drive";
      case GyroFault::kDelay:
        return of_delay(one.delay_s);
      case GyroFault::kStuck:
        return "the gyro repeats its value while the robot rotates, and is not used: check that it "
               "is read anew for each reading, and its wires";
      case GyroFault::kUnrelated:
        return names_.is_kernel
                   ? "the gyro does not measure the robot's rotation: set "
                     "advanced.odometry.kernel.gyro.axis to the one that points up"
                   : "the gyro does not measure the robot's rotation: send the rate about the axis "
                     "that points up";
    }
    return {};
  }

 private:
  std::string of_wiring(const Wiring& wiring) const {
    std::string text;
    const auto add = [&](const std::string& part) { text += (text.empty() ? "" : "; ") + part; };
    if (wiring.is_swapped) {
      add(names_.is_kernel ? "left and right are exchanged: swap advanced.odometry.kernel.left and "
                             "advanced.odometry.kernel.right"
                           : "left and right are exchanged: swap left and right in the ODOMETRY "
                             "lines");
    }
    const std::string left = reverse("left", names_.left_is_reversed);
    const std::string right = reverse("right", names_.right_is_reversed);
    if (wiring.left_is_reversed && wiring.right_is_reversed) {
      add("both wheels count backward: " + left + " and " + right);
    } else if (wiring.left_is_reversed) {
      add("the left counts go backward: " + left);
    } else if (wiring.right_is_reversed) {
      add("the right counts go backward: " + right);
    }
    return text;
  }

  /// The remedy for a wrong sign.
  std::string reverse(const std::string& name, bool is_reversed) const {
    if (!names_.is_kernel) return "negate " + name + " in the ODOMETRY lines";
    return "set advanced.odometry.kernel." + name + ".reversed to " +
           (is_reversed ? "false" : "true");
  }

  std::string of_counts(double factor) const {
    const double whole = std::round(std::max(factor, 1 / factor));
    const double plain = factor > 1 ? whole : 1 / whole;
    const bool is_plain = std::abs(factor / plain - 1) < kIntegerTolerance;
    const double taken = is_plain ? plain : factor;
    const std::string text = "the wheels move " + number("%.3g", factor) +
                             " times as far as their counts: set odometry.counts_per_turn to " +
                             number("%.5g", names_.geometry.counts_per_turn / taken);
    // The four edges of an encoder's two lines.
    if (is_plain && whole == 4) return text;
    return text + " or odometry.wheel_radius to " +
           number("%.4g", names_.geometry.wheel_radius_m * taken) + ", whichever is wrong";
  }

  static std::string of_one_wheel(const std::string& name, double factor) {
    return "the " + name + " wheel moves " + number("%.3g", factor) +
           " times as far as its counts: count the edges of both encoders alike";
  }

  static std::string of_unrelated(const std::string& name, const std::string& other,
                                  const DriveHypothesis& one) {
    if (one.is_copy) {
      return "the " + name + " counts are those of the " + other +
             " wheel: check that each encoder has its own input";
    }
    return "the " + name + " counts do not " +
           (one.is_silent ? "change while the robot drives" : "follow the motion of their wheel") +
           ": check that encoder and its wires";
  }

  std::string of_delay(double delay_s) const {
    return "the times of counts or gyro are about " + number("%.1f s", std::abs(delay_s)) +
           (delay_s > 0 ? " late" : " early") +
           (names_.is_kernel ? ": the encoders' or the gyro's driver gives wrong times"
                             : ": send as t of ODOMETRY the UNIX time of the reading, by the "
                               "clock of cornerd's computer");
  }

  std::string of_turn(const DriveHypothesis& one) const {
    const double theta_rad = one.T_base_lidar.theta_rad;
    const double turn_rad = core::angle_between(names_.T_base_lidar.theta_rad, theta_rad);
    return "the lidar looks " + number("%.3g", std::abs(core::degrees(turn_rad))) +
           " degrees off what lidar.mount says: set lidar.mount.theta to " +
           number("%.4f", theta_rad);
  }

  std::string of_place(const DriveHypothesis& one) const {
    const core::Vec2 off_m = one.T_base_lidar.translation() - names_.T_base_lidar.translation();
    return "the lidar sits " + number("%.0f mm", 1000 * off_m.norm()) +
           " off what lidar.mount says: set lidar.mount.x to " +
           number("%.3f", one.T_base_lidar.x_m) + " and lidar.mount.y to " +
           number("%.3f", one.T_base_lidar.y_m);
  }

  const OdometryNames& names_;
};

/// "A", "either A, or B".
template <typename Hypothesis>
std::string joined(const std::vector<Hypothesis>& hypotheses, const FaultText& text) {
  std::string all;
  for (const Hypothesis& one : hypotheses) {
    const std::string sentence = text.of(one);
    if (all.find(sentence) != std::string::npos) continue;
    all += (all.empty() ? "" : ", or ") + sentence;
  }
  return hypotheses.size() > 1 && all.find(", or ") != std::string::npos ? "either " + all : all;
}

}  // namespace

std::string_view name_of(const DriveHypothesis& hypothesis) {
  switch (hypothesis.fault) {
    case DriveFault::kNone:
      return "none";
    case DriveFault::kWiring: {
      const Wiring& wiring = hypothesis.wiring;
      if (wiring.is_swapped && wiring.left_is_reversed && wiring.right_is_reversed) {
        return "wheels-swapped-and-reversed";
      }
      if (wiring.left_is_reversed && wiring.right_is_reversed) return "wheels-reversed";
      if (wiring.is_swapped && wiring.left_is_reversed) return "wheels-swapped-left-reversed";
      if (wiring.is_swapped && wiring.right_is_reversed) return "wheels-swapped-right-reversed";
      if (wiring.is_swapped) return "wheels-swapped";
      if (wiring.left_is_reversed) return "left-wheel-reversed";
      return wiring.right_is_reversed ? "right-wheel-reversed" : "counts-per-turn";
    }
    case DriveFault::kCounts:
      return "counts-per-turn";
    case DriveFault::kLeftCounts:
      return "left-counts";
    case DriveFault::kRightCounts:
      return "right-counts";
    case DriveFault::kTrack:
      return "track";
    case DriveFault::kLeftUnrelated:
      return "left-encoder";
    case DriveFault::kRightUnrelated:
      return "right-encoder";
    case DriveFault::kBothUnrelated:
      return "encoders";
    case DriveFault::kDelay:
      return "odometry-delay";
    case DriveFault::kMountTurned:
      return "mount-theta";
    case DriveFault::kMountDisplaced:
      return "mount-position";
    case DriveFault::kMountBoth:
      return "mount";
  }
  return {};
}

std::string_view name_of(const GyroHypothesis& hypothesis) {
  constexpr std::array<std::string_view, 9> kNames = {
      "none",       "gyro-reversed", "gyro-degrees",   "gyro-degrees-reversed",
      "gyro-scale", "gyro-bias",     "odometry-delay", "gyro-stuck",
      "gyro-axis"};
  return kNames[static_cast<std::size_t>(hypothesis.fault)];
}

std::vector<std::string_view> names_of(const DriveFaults& faults) {
  std::vector<std::string_view> names;
  const auto add = [&](std::string_view name) {
    if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
  };
  for (const DriveHypothesis& one : faults.drive) add(name_of(one));
  for (const GyroHypothesis& one : faults.gyro) add(name_of(one));
  return names;
}

std::string describe(const DriveFaults& faults, const OdometryNames& names) {
  const FaultText text(names);
  const std::string drive = joined(faults.drive, text);
  const std::string gyro = joined(faults.gyro, text);
  // Times that are late concern both.
  return drive == gyro ? drive : drive + (drive.empty() || gyro.empty() ? "" : "; ") + gyro;
}

}  // namespace cornerd::calibration
