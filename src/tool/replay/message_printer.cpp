// SPDX-License-Identifier: MIT
#include "tool/replay/message_printer.hpp"

#include <array>

#include "drivers/lidar_status.hpp"

namespace cornerd::tool {

using message::MessageClass;

MessagePrinter::MessagePrinter(Output& output, message::ClassSet classes,
                               const core::FloorPlan* plan)
    : output_(output), classes_(classes), plan_(plan) {
  if (classes_.contains(MessageClass::kVersion)) {
    output_.write(writer_.version("cornerctl", CORNERD_VERSION));
  }
  if (plan_ != nullptr && classes_.contains(MessageClass::kMap)) output_.write(writer_.map(*plan_));
}

void MessagePrinter::print_scan(const core::Scan& scan, const core::ScanResult& result) {
  odometry_ = result.odometry;
  if (classes_.contains(MessageClass::kScan)) output_.write(writer_.scan(scan));
  if (classes_.contains(MessageClass::kBreakpoints)) {
    output_.write(writer_.breakpoints(scan.start_ns(), result.detection));
  }
  print_pose(result.pose);
}

void MessagePrinter::print_pose(const core::PoseEstimate& pose) {
  if (classes_.contains(MessageClass::kPose)) output_.write(writer_.pose(pose, plan_));
}

void MessagePrinter::print_odom(const core::OdometryPose& pose) {
  if (classes_.contains(MessageClass::kOdom)) output_.write(writer_.odom(pose));
}

void MessagePrinter::begin_recording() {
  last_status_.reset();
  odometry_ = {};
  odometry_lines_ = {};
}

void MessagePrinter::print_status_when_due(core::TimeNs t_ns,
                                           const drivers::StreamCounters& counters) {
  if (!last_status_) {
    last_status_ = {t_ns, counters};
  } else if (t_ns - last_status_->t_ns >= core::kNsPerSecond) {
    print_status(t_ns, counters, drivers::LidarState::kRunning);
  }
}

void MessagePrinter::print_status(core::TimeNs t_ns, const drivers::StreamCounters& counters,
                                  drivers::LidarState state) {
  if (!classes_.contains(MessageClass::kStatus)) return;

  std::array<message::StatusFields::Counter, drivers::kCounterNames.size()> named;
  for (std::size_t i = 0; i < named.size(); ++i) {
    named[i] = {drivers::kCounterNames[i].name, counters.*drivers::kCounterNames[i].member};
  }
  message::StatusFields status;
  status.t_ns = t_ns;
  status.lidar_state = drivers::to_string(state);
  status.counters = named;
  status.odometry = &odometry_;
  status.odometry_hint = odometry_lines_.hint(odometry_, t_ns);
  if (status.odometry_hint.empty() && plan_ == nullptr) {
    status.odometry_hint = "no calibration without a map: name one with --map";
  }
  if (last_status_ && t_ns > last_status_->t_ns) {
    const double elapsed_s = core::to_seconds(t_ns - last_status_->t_ns);
    const auto rate = [&](std::uint64_t now, std::uint64_t then) {
      return static_cast<double>(now - then) / elapsed_s;
    };
    status.rate_hz = rate(counters.scans, last_status_->counters.scans);
    status.samples_hz = rate(counters.samples, last_status_->counters.samples);
  }
  output_.write(writer_.status(status));
  last_status_ = {t_ns, counters};
}

}  // namespace cornerd::tool
