// SPDX-License-Identifier: MIT
#include "tool/calibrate/wiring_fault_text.hpp"

#include <cmath>
#include <string_view>
#include <vector>

#include "tool/drawing/text_table.hpp"

namespace cornerd::tool {

namespace {

using calibration::WiringFaults;

/// A factor this near to an integer counts as the integer.
constexpr double kIntegerTolerance = 0.1;

class FaultText {
 public:
  FaultText(const WiringFaults& faults, const settings::OdometryConfig& config)
      : faults_(faults), config_(config) {}

  std::string text() {
    add_stuck();
    add_directions();
    add_factors();
    add_gyro();
    std::string all;
    for (const std::string& sentence : sentences_) {
      all += (all.empty() ? "" : "; ") + sentence;
    }
    return all;
  }

 private:
  bool is_kernel() const { return config_.source == settings::OdometrySource::kKernel; }
  void add(std::string sentence) { sentences_.push_back(std::move(sentence)); }

  void add_stuck() {
    if (faults_.left_is_stuck && faults_.right_is_stuck) {
      add("neither wheel's counts change while the robot drives: check both encoders");
    } else if (faults_.left_is_stuck || faults_.right_is_stuck) {
      add(
          formatted("the %s counts do not change while the robot drives: check that encoder and "
                    "its wires",
                    faults_.left_is_stuck ? "left" : "right"));
    }
  }

  void add_directions() {
    const bool both = faults_.left_is_reversed && faults_.right_is_reversed;
    if (both && faults_.are_swapped) {
      return add(
          "wheels and lidar measure opposite directions: lidar.mount.theta is off by 180 "
          "degrees, or left and right are exchanged and both count backward");
    }
    if (faults_.are_swapped) {
      add(is_kernel() ? "left and right are exchanged: swap advanced.odometry.kernel.left and "
                        "advanced.odometry.kernel.right"
                      : "left and right are exchanged: swap left and right in the ODOMETRY lines");
    }
    if (both) {
      add("both wheels count backward: " + reverse("left") + " and " + reverse("right"));
    } else if (faults_.left_is_reversed || faults_.right_is_reversed) {
      const char* name = faults_.left_is_reversed ? "left" : "right";
      add(formatted("the %s wheel counts backward: ", name) + reverse(name));
    }
  }

  /// The remedy for a wrong sign of a wheel or the gyro.
  std::string reverse(std::string_view name) const {
    if (!is_kernel()) return "negate " + std::string(name) + " in the ODOMETRY lines";
    const drivers::KernelOdometryConfig& kernel = config_.kernel;
    const bool is_reversed = name == "left"    ? kernel.left.reversed
                             : name == "right" ? kernel.right.reversed
                                               : kernel.gyro.reversed;
    return "set advanced.odometry.kernel." + std::string(name) + ".reversed to " +
           (is_reversed ? "false" : "true");
  }

  void add_factors() {
    if (faults_.left_factor && faults_.right_factor) {
      const double left = *faults_.left_factor;
      const double right = *faults_.right_factor;
      if (left == right) {
        add(formatted("the wheels move %.3g times as far as their counts: ", left) +
            corrections(left));
      } else {
        add(
            formatted("the left wheel moves %.3g times as far as its counts, the right one "
                      "%.3g times: count the edges of both encoders alike",
                      left, right));
      }
    }
    if (faults_.track_m) {
      add(formatted("the rotations match a track of %.3g m: correct odometry.track",
                    *faults_.track_m));
    }
  }

  std::string corrections(double factor) const {
    const core::DriveGeometry& geometry = config_.core.geometry;
    const double whole = std::round(std::max(factor, 1 / factor));
    const double plain = factor > 1 ? whole : 1 / whole;
    const bool is_plain = std::abs(factor / plain - 1) < kIntegerTolerance;
    const double taken = is_plain ? plain : factor;
    const std::string counts =
        formatted("set odometry.counts_per_turn to %.7g", geometry.counts_per_turn / taken);
    // The four edges of an encoder's two lines.
    if (is_plain && whole == 4) return counts;
    return counts + formatted(" or odometry.wheel_radius to %.4g, whichever is wrong",
                              geometry.wheel_radius_m * taken);
  }

  void add_gyro() {
    if (faults_.gyro_is_unrelated) {
      add(is_kernel()
              ? "the gyro does not measure the robot's rotation: set "
                "advanced.odometry.kernel.gyro.axis "
                "to the one that points up"
              : "the gyro does not measure the robot's rotation: send the rate about the axis "
                "that points up");
    }
    if (faults_.gyro_is_reversed) {
      add("the gyro's sign is reversed; a rotation to the left is positive: " + reverse("gyro"));
    }
    if (faults_.gyro_factor) {
      constexpr double kDegrees = 180 / core::kPi;
      const bool is_degrees = std::abs(*faults_.gyro_factor / kDegrees - 1) < 2 * kIntegerTolerance;
      add(formatted("the gyro reads %.3g times the true rate: %s radians a second",
                    *faults_.gyro_factor,
                    is_degrees ? "it is in degrees a second, send" : "it has to be in"));
    }
    if (faults_.gyro_bias_rad_s) {
      add(formatted(
          "the gyro reads %+.2f rad/s while the robot stands: calibrate its zero before the drive",
          *faults_.gyro_bias_rad_s));
    }
  }

  const WiringFaults& faults_;
  const settings::OdometryConfig& config_;
  std::vector<std::string> sentences_;
};

}  // namespace

std::string describe_faults(const WiringFaults& faults, const settings::OdometryConfig& config) {
  return FaultText(faults, config).text();
}

}  // namespace cornerd::tool
