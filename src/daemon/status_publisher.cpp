// SPDX-License-Identifier: MIT
#include "daemon/status_publisher.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <string_view>
#include <utility>
#include <vector>

#include "daemon/log.hpp"
#include "drivers/lidar_status.hpp"
#include "message/line_writer.hpp"
#include "settings/odometry_names.hpp"

namespace cornerd::daemon {
namespace {

using drivers::LidarFault;
using drivers::LidarState;
using message::MessageClass;
using Counter = message::StatusFields::Counter;

/// In the order of core::PoseState.
constexpr std::array<std::string_view, ScanPublisher::kStates> kPoseCounterNames = {
    "poses_fix", "poses_tracking", "poses_predicted", "poses_ambiguous", "poses_lost"};

/// More than the different texts of a driver.
constexpr std::size_t kMaxLidarTexts = 64;

bool is_fault(const drivers::LidarChange& change) {
  return change.fault != LidarFault::kNone || change.state == LidarState::kFaulty ||
         change.state == LidarState::kAbsent || change.state == LidarState::kBackoff;
}

/// "faulty, dead-laser: its head turns, but ..."
std::string describe(LidarState state, LidarFault fault, std::string_view detail) {
  std::string text(drivers::to_string(state));
  if (fault != LidarFault::kNone) text.append(", ").append(drivers::to_string(fault));
  if (!detail.empty()) text.append(": ").append(detail);
  return text;
}

/// EVENT.what of a change.
std::string_view name_of(const std::optional<drivers::LidarChange>& from,
                         const drivers::LidarChange& to) {
  const bool ran = from && from->state == LidarState::kRunning;
  if (to.state == LidarState::kRunning) return "device found";
  if (ran && to.state != LidarState::kFaulty) return "device lost";
  return to.fault == LidarFault::kNone ? "device state" : "device fault";
}

bool is_gone(const core::MapChange& change) {
  return change.kind == core::MapChange::Kind::kWallGone;
}

}  // namespace

StatusPublisher::StatusPublisher(MessageServer& server, Notifier& notifier)
    : server_(server), notifier_(notifier) {}

void StatusPublisher::configure(const settings::Config& config) {
  const core::OdometryConfig& odometry = config.odometry.core;
  names_ = settings::odometry_names(config);
  mount_ = {names_.T_base_lidar, config.lidar.mount.inverted, {}};
  if (!odometry.enabled) {
    drive_.reset();
  } else if (!drive_ || !drive_->is_of(odometry, names_.T_base_lidar)) {
    drive_.emplace(odometry, names_.T_base_lidar);
  }
  map_examiner_.configure(config);
}

void StatusPublisher::set_walls(const WallReport* report, const core::WallMap* map,
                                core::TimeNs t_ns) {
  if (report == nullptr || map == nullptr) return;
  walls_ = {.learned = report->walls.offsets.size()};
  std::vector<double> sigmas_m;
  for (const core::WallOffset& wall : report->walls.offsets) {
    sigmas_m.push_back(wall.sigma_m);
    walls_.offset_m = std::max(walls_.offset_m, std::abs(wall.offset_m));
  }
  if (!sigmas_m.empty()) {
    const auto median = sigmas_m.begin() + static_cast<std::ptrdiff_t>(sigmas_m.size() / 2);
    std::nth_element(sigmas_m.begin(), median, sigmas_m.end());
    walls_.sigma_m = *median;
  }
  for (const core::MapChange& change : report->changes) {
    if (std::ranges::find(changes_, change) != changes_.end()) continue;
    const std::string text = settings::describe(change, map->plan());
    log(LogLevel::kInfo, "map: " + text);
    server_.publish(MessageClass::kEvent, line_.event(t_ns, "map change", text));
  }
  changes_ = report->changes;
}

void StatusPublisher::observe(const ScanReport& report) {
  const core::PoseEstimate& pose = report.result.pose;
  map_examiner_.observe(report);
  const bool is_other_map = std::exchange(generation_, report.generation) != report.generation;
  if (drive_ && (is_other_map || report.follows_initial_pose)) drive_->interrupt();
  if (drive_ && core::has_pose(pose.state)) {
    drive_->add(pose.t_ns - report.to_unix_ns, pose.T_map_base);
  }
}

void StatusPublisher::observe(const core::OdometryReading& reading) {
  if (drive_) drive_->add(reading);
}

bool StatusPublisher::update(const drivers::LidarChange& change, core::TimeNs t_ns) {
  const std::string text = describe(change.state, change.fault, change.detail.view());
  if (text == text_) return false;
  text_ = text;
  log_once(change, text);
  const bool is_new = !last_ || last_->state != change.state || last_->fault != change.fault;
  if (is_new) {
    server_.publish(MessageClass::kEvent, line_.event(t_ns, name_of(last_, change), text));
  }
  last_ = change;
  return true;
}

void StatusPublisher::log_once(const drivers::LidarChange& change, const std::string& text) {
  if (change.state == LidarState::kRunning) logged_texts_.clear();
  if (logged_texts_.size() == kMaxLidarTexts) logged_texts_.clear();
  if (!logged_texts_.insert(text).second) return;
  log(is_fault(change) ? LogLevel::kWarning : LogLevel::kInfo, "lidar " + text);
}

drivers::LidarStatus StatusPublisher::with_last_fault(const drivers::LidarStatus& lidar) {
  if (lidar.fault != LidarFault::kNone) {
    last_fault_ = {lidar.state, lidar.fault, lidar.detail};
  } else if (lidar.state == LidarState::kRunning) {
    last_fault_.reset();
  }
  drivers::LidarStatus status = lidar;
  if (last_fault_) {
    status.fault = last_fault_->fault;
    status.detail = last_fault_->detail;
  }
  return status;
}

void StatusPublisher::publish(const drivers::LidarStatus& lidar, const ScanPublisher& scans,
                              Localization& localization, const DaemonHealth& health,
                              core::TimeNs t_ns) {
  std::array<Counter, drivers::kCounterNames.size() + kPoseCounterNames.size() + 4> counters;
  auto next = counters.begin();
  for (const auto& [name, member] : drivers::kCounterNames) {
    *next++ = {name, lidar.counters.*member};
  }
  for (std::size_t i = 0; i < kPoseCounterNames.size(); ++i) {
    *next++ = {kPoseCounterNames[i], scans.poses()[i]};
  }
  *next++ = {"lost_samples", localization.lost_samples()};
  *next++ = {"lost_scans", localization.lost_reports()};
  *next++ = {"clients", server_.clients()};
  *next++ = {"dropped_messages", server_.dropped()};

  message::StatusFields status;
  status.t_ns = t_ns;
  status.lidar_state = drivers::to_string(lidar.state);
  status.lidar_fault = drivers::to_string(lidar.fault);
  status.lidar_detail = lidar.detail.view();
  status.lidar_model = lidar.model.view();
  status.lidar_firmware = lidar.firmware.view();
  status.lidar_serial = lidar.serial.view();
  status.lidar_health = lidar.health.view();
  status.lidar_mode = lidar.mode.view();
  status.rate_hz = lidar.rate_hz;
  status.samples_hz = lidar.samples_hz;
  status.mount = mount_;
  status.bias = &scans.bias();
  status.map = scans.choice();
  status.walls = walls_;
  status.walls_gone =
      static_cast<std::size_t>(std::count_if(changes_.begin(), changes_.end(), is_gone));
  status.new_things = changes_.size() - status.walls_gone;
  status.counters = counters;
  status.odometry = &scans.odometry();
  if (odometry_ != nullptr) odometry_->describe(status);
  if (odometry_clients_ != nullptr) odometry_clients_->describe(status);
  static const calibration::DriveFaults kNoFaults;
  const calibration::DriveFaults& drive = drive_ ? drive_->faults() : kNoFaults;
  if (drive_ && drive.mount.sigma.theta_rad > 0) {
    status.mount->estimated = {drive.mount.T_base_lidar, drive.mount.sigma};
  }
  calibration::FaultList faults;
  const drivers::LidarStatus reported = with_last_fault(lidar);
  if (reported.fault != LidarFault::kNone) {
    faults.add(drivers::to_string(reported.fault), std::string(reported.detail.view()));
  } else if (reported.state == LidarState::kFaulty) {
    // Only a recording fails without a fault of a device.
    faults.add("recording", std::string(reported.detail.view()));
  }
  line_quality_.add(lidar.counters.bytes, lidar.counters.skipped_bytes);
  if (line_quality_.is_damaged()) {
    faults.add(
        "damaged-line",
        std::to_string(std::lround(100 * line_quality_.skipped_share())) +
            " % of the lidar's bytes are damaged or missing: use a shorter or shielded cable, "
            "away from motors, and a stable 5 V supply");
  }
  faults.add_map(map_examiner_.update(scans.recent().doubts_map(), scans.map()), scans.recent(),
                 scans.map() != nullptr ? &scans.map()->plan() : nullptr);
  faults.add_drive(drive, names_, scans.recent(), scans.odometry());
  if (!status.odometry_hint.empty()) {
    faults.add(status.odometry_fault, std::string(status.odometry_hint));
  }
  if (!walls_problem_.empty()) faults.add("walls-file", walls_problem_);
  if (!calibration_problem_.empty()) faults.add("calibration-file", calibration_problem_);
  status.faults = faults.names();
  status.hint = faults.hint();
  const LatencyWindow& latencies = scans.latencies();
  status.latency = {latencies.percentile(0.5), latencies.percentile(0.95),
                    latencies.percentile(0.99), !latencies.empty()};
  const LoopHealth localizer = localization.localizer_health();
  const std::array<message::StatusFields::Loop, 3> loops = {{
      {"reader", &lidar.latency, localization.reader_page_faults()},
      {"localizer", &localizer.latency, localizer.page_faults},
      {"server", &health.server, std::nullopt},
  }};
  status.realtime_priority = health.priority;
  status.memory_is_locked = health.memory_is_locked;
  status.loops = loops;
  server_.publish(MessageClass::kStatus, line_.status(status));

  std::string summary = "lidar " + describe(lidar.state, lidar.fault, lidar.detail.view());
  if (lidar.state == LidarState::kRunning && scans.state()) {
    summary.append("; pose ").append(message::to_string(*scans.state()));
  }
  notifier_.status(summary);
}

}  // namespace cornerd::daemon
