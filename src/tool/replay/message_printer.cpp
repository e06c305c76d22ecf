// SPDX-License-Identifier: MIT
#include "tool/replay/message_printer.hpp"

#include <array>

#include "drivers/lidar_status.hpp"
#include "settings/map_examination.hpp"
#include "settings/odometry_names.hpp"

namespace cornerd::tool {

using message::MessageClass;

MessagePrinter::MessagePrinter(Output& output, message::ClassSet classes, const core::WallMap* map,
                               const settings::Config* config)
    : config_(config),
      output_(output),
      classes_(classes),
      map_(map),
      plan_(map != nullptr ? &map->plan() : nullptr) {
  if (classes_.contains(MessageClass::kVersion)) {
    output_.write(writer_.version("cornerctl", CORNERD_VERSION));
  }
  if (plan_ != nullptr && classes_.contains(MessageClass::kMap)) output_.write(writer_.map(*plan_));
}

void MessagePrinter::print_scan(const core::Scan& scan, const core::ScanResult& result) {
  odometry_ = result.odometry;
  if (drive_ && core::has_pose(result.pose.state)) {
    drive_->add(result.pose.t_ns, result.pose.T_map_base);
  }
  const calibration::RecentPoses::Limits limits =
      config_ == nullptr ? calibration::RecentPoses::Limits{}
                         : calibration::RecentPoses::Limits{config_->lidar.min_range_m,
                                                            config_->lidar.max_range_m};
  recent_.add(result, scan, limits, map_);
  if (plan_ != nullptr) scans_.add(scan);
  if (classes_.contains(MessageClass::kScan)) output_.write(writer_.scan(scan));
  if (classes_.contains(MessageClass::kBreakpoints)) {
    output_.write(writer_.breakpoints(scan.start_ns(), result.detection));
  }
  print_pose(result.pose);
}

void MessagePrinter::note(const core::OdometryReading& reading) {
  has_odometry_lines_ = true;
  odometry_lines_.add(reading);
  if (drive_) drive_->add(reading);
}

void MessagePrinter::refuse(const message::RequestError& error) {
  has_odometry_lines_ = true;
  odometry_lines_.refuse(error);
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
  has_odometry_lines_ = false;
  recent_ = {};
  scans_ = {};
  drive_.reset();
  if (config_ != nullptr && config_->odometry.core.enabled) {
    drive_.emplace(config_->odometry.core, config_->localizer().T_base_lidar);
  }
}

void MessagePrinter::print_status_when_due(core::TimeNs t_ns,
                                           const drivers::StreamCounters& counters) {
  if (!last_status_) {
    last_status_ = {t_ns, counters};
  } else if (t_ns - last_status_->t_ns >= core::kNsPerSecond) {
    print_status(t_ns, counters, drivers::LidarState::kRunning);
  }
}

calibration::FaultList MessagePrinter::faults(const message::StatusFields& status, bool has_ended) {
  calibration::FaultList faults;
  if (plan_ != nullptr) {
    std::optional<calibration::MapFinding> finding;
    if (has_ended && config_ != nullptr && scans_.are_enough() && recent_.doubts_map()) {
      finding = settings::examine_map(*plan_, *config_, scans_.all(), [] { return false; });
    }
    faults.add_map(finding, recent_, plan_);
  }
  if (drive_) {
    faults.add_drive(drive_->faults(), settings::odometry_names(*config_), recent_, odometry_);
    if (!status.odometry_hint.empty()) {
      faults.add(odometry_lines_.fault(), std::string(status.odometry_hint));
    }
  }
  return faults;
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
  odometry_lines_.update(odometry_.counters, t_ns);
  status.odometry_hint = odometry_lines_.hint(odometry_.present);
  if (!status.odometry_hint.empty() && !has_odometry_lines_) {
    status.odometry_hint =
        "the recording has no ODOMETRY line so far: name a file of them with --odometry";
  }
  const calibration::FaultList faults = this->faults(status, state == drivers::LidarState::kEnded);
  if (status.odometry_hint.empty() && plan_ == nullptr) {
    status.odometry_hint = "no calibration without a map: name one with --map";
  }
  status.faults = faults.names();
  status.hint = faults.hint();
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
