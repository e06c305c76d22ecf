// SPDX-License-Identifier: MIT
#include <cerrno>
#include <cstring>

#include "tool/doctor/checks.hpp"
#include "tool/doctor/process_table.hpp"
#include "tool/doctor/service_unit.hpp"
#include "tool/drawing/text_table.hpp"

namespace cornerd::tool {

namespace {

/// More damaged bytes than line noise explains.
constexpr double kMaxSkippedShare = 0.01;
constexpr std::string_view kDoctorAdvice = ". `sudo cornerctl doctor`";

std::vector<Finding> unreachable(const Patient& patient) {
  const std::string socket = patient.config.socket.pose.string();
  const int error = patient.daemon.connect_errno;
  const auto process = find_process(patient.machine, "cornerd");
  if (error == EACCES) {
    return {{Verdict::kWrong,
             "daemon",
             socket + ": you may not enter its folder",
             {"sudo cornerctl doctor, or correct the rights of the folder"}}};
  }
  if (process) {
    return {{Verdict::kWrong,
             "daemon",
             "cornerd runs (process " + std::to_string(process->pid) +
                 "), but not with the socket " + socket,
             {"name the config that it runs with: cornerctl doctor --config FILE"}}};
  }
  Finding finding{Verdict::kWrong, "daemon",
                  "does not run (" + socket + ": " + std::strerror(error) + ")"};
  if (has_service_unit(patient.machine)) {
    finding.remedies = {"sudo systemctl start cornerd",
                        "why it ended: journalctl -u cornerd -n 20"};
  } else {
    finding.remedies = {"cornerd --config FILE, or install the package"};
  }
  return {finding};
}

/// "running, A1M8 firmware 1.29, health good, 7.1 scans/s"
std::string describe_lidar(const message::ParsedStatus& status) {
  std::string text = status.lidar_state;
  if (!status.lidar_fault.empty()) text += ", " + status.lidar_fault;
  if (!status.lidar_detail.empty()) {
    // Whoever reads this has just done what the end of some advises.
    return text + ": " + status.lidar_detail.substr(0, status.lidar_detail.find(kDoctorAdvice));
  }
  if (!status.lidar_model.empty()) text += ", " + status.lidar_model;
  if (!status.lidar_firmware.empty()) text += " firmware " + status.lidar_firmware;
  if (!status.lidar_health.empty()) text += ", health " + status.lidar_health;
  if (status.rate_hz) text += formatted(", %.1f scans/s", *status.rate_hz);
  return text;
}

Finding lidar_finding(const message::ParsedStatus& status) {
  const bool runs = status.lidar_state == "running" && status.lidar_fault.empty();
  Finding finding{runs ? Verdict::kGood : Verdict::kWrong, "lidar", describe_lidar(status)};
  // The daemon's own text says what to do about the rest.
  if (!runs && status.lidar_detail.empty()) {
    finding.remedies = {"see again in some seconds: it may only be starting"};
  }
  return finding;
}

void add_line_quality(const message::ParsedStatus& status, std::vector<Finding>& findings) {
  const auto bytes = static_cast<double>(status.counter("bytes"));
  const double share = bytes > 0 ? static_cast<double>(status.counter("skipped_bytes")) / bytes : 0;
  if (share <= kMaxSkippedShare) return;
  findings.push_back(
      {Verdict::kNote,
       "line",
       formatted("%.1f %% of the lidar's bytes were damaged or belonged to nothing", 100 * share),
       {"a shorter or screened cable, away from motors; a steadier 5 V"}});
}

/// Scans in motion are deskewed by what was read meanwhile: with fewer readings than the first,
/// scans are lost and what is carried on may be wrong; with fewer than the second, fixes are worse
/// than they say (core/odometry/README.md).
constexpr double kMinReadings_hz = 10;
constexpr double kGoodReadings_hz = 20;

void add_reading_rate(const Patient& patient, std::vector<Finding>& findings) {
  const std::optional<double> hz = patient.daemon.odometry_hz;
  if (!hz || *hz >= kGoodReadings_hz) return;
  if (*hz <= 0) {
    if (patient.daemon.status && !patient.daemon.status->odometry_hint.empty()) return;
    findings.push_back({Verdict::kNote,
                        "odometry",
                        "the config has it, and no reading comes",
                        {"start what sends ODOMETRY to control.sock"}});
    return;
  }
  const bool is_wrong = *hz < kMinReadings_hz;
  const std::string mend = patient.config.odometry.source == settings::OdometrySource::kKernel
                               ? "advanced.odometry.kernel.rate: 50"
                               : "send ODOMETRY 50 times a second, wheels and gyro in one line";
  findings.push_back({is_wrong ? Verdict::kWrong : Verdict::kNote,
                      "odometry",
                      formatted("%.1f readings a second: ", *hz) +
                          (is_wrong ? "too few, predicted poses of a robot in motion may be wrong"
                                    : "fixes of a robot in motion are worse than they say"),
                      {mend}});
}

/// The daemon's own words say what to do.
void add_hint(const message::ParsedStatus& status, std::vector<Finding>& findings) {
  if (status.odometry_hint.empty()) return;
  findings.push_back({Verdict::kWrong,
                      "odometry",
                      status.odometry_state + ": " + status.odometry_hint,
                      {"README.md, \"Odometry\", has what a line bears"}});
}

}  // namespace

std::vector<Finding> check_daemon(const Patient& patient) {
  const DaemonView& daemon = patient.daemon;
  // EAGAIN: its queue of those who want to be let in is full.
  const bool hangs = daemon.connect_errno == EAGAIN;
  if (daemon.connect_errno != 0 && !hangs) return unreachable(patient);
  if (hangs || daemon.version.empty()) {
    return {
        {Verdict::kWrong,
         "daemon",
         "takes connections and says nothing: it hangs, or its socket waits for one that cannot "
         "start",
         {"sudo systemctl restart cornerd", "why it does not start: journalctl -u cornerd -n 20"}}};
  }
  std::vector<Finding> findings = {
      {Verdict::kGood, "daemon",
       "cornerd " + daemon.version + " answers on " + patient.config.socket.pose.string()}};
  if (!daemon.status) return findings;
  findings.push_back(lidar_finding(*daemon.status));
  add_line_quality(*daemon.status, findings);
  for (const message::ParsedStatus::Sensor& sensor : daemon.status->odometry_sensors) {
    if (sensor.state == "running") continue;
    findings.push_back(
        {Verdict::kWrong,
         "odometry",
         sensor.name + " is " + sensor.state + (sensor.detail.empty() ? "" : ": " + sensor.detail),
         {"drivers/odometry/README.md has pins, overlays and names"}});
  }
  add_hint(*daemon.status, findings);
  add_reading_rate(patient, findings);
  return findings;
}

std::vector<Finding> check_control(const Patient& patient) {
  const std::optional<gid_t> group = find_group(patient.machine, "cornerd");
  const Account& caller = patient.caller;
  if (!group || caller.uid == 0) return {};
  if (caller.gids.contains(*group)) {
    return {{Verdict::kGood, "control",
             caller.name + " is in the group cornerd and may send requests"}};
  }
  const std::optional<Account> account = find_account(patient.machine, caller.name);
  if (account && account->gids.contains(*group)) {
    return {{Verdict::kNote,
             "control",
             caller.name + " is in the group cornerd, this session is older than that",
             {"log out and in again"}}};
  }
  return {{Verdict::kNote,
           "control",
           caller.name + " may read poses, but send no requests (odometry, SET_POSE, RELOCALIZE)",
           {"sudo usermod -aG cornerd " + caller.name + ", then log out and in again"}}};
}

}  // namespace cornerd::tool
