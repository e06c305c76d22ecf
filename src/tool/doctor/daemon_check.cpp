// SPDX-License-Identifier: MIT
#include <cerrno>
#include <cstring>

#include "tool/doctor/checks.hpp"
#include "tool/doctor/process_table.hpp"
#include "tool/doctor/service_unit.hpp"
#include "tool/drawing/text_table.hpp"

namespace cornerd::tool {

namespace {

/// Line noise damages fewer bytes than this.
constexpr double kMaxSkippedShare = 0.01;
/// Less than two seconds of an A1 tells nothing of the line.
constexpr double kMinBytes = 8000;
constexpr std::string_view kDoctorAdvice = ". `sudo cornerctl doctor`";

std::vector<Finding> unreachable(const Patient& patient) {
  const std::string socket = patient.config.socket.pose.string();
  const int error = patient.daemon.connect_errno;
  const auto process = find_process(patient.machine, "cornerd");
  if (error == EACCES) {
    return {{Verdict::kWrong,
             "daemon",
             socket + ": you must not enter its folder",
             {"run sudo cornerctl doctor, or correct the rights of the folder"}}};
  }
  if (process) {
    return {{Verdict::kWrong,
             "daemon",
             "cornerd runs (process " + std::to_string(process->pid) +
                 "), but not with the socket " + socket,
             {"name its config: cornerctl doctor --config FILE"}}};
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
    // The caller is already running doctor.
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
  // Otherwise lidar_detail holds the remedy.
  if (!runs && status.lidar_detail.empty()) {
    finding.remedies = {"try again in a few seconds: it may still be starting"};
  }
  return finding;
}

void add_line_quality(const message::ParsedStatus& status, std::vector<Finding>& findings) {
  const auto bytes = static_cast<double>(status.counter("bytes"));
  const double share = bytes > 0 ? static_cast<double>(status.counter("skipped_bytes")) / bytes : 0;
  if (bytes < kMinBytes || share <= kMaxSkippedShare) return;
  findings.push_back(
      {Verdict::kNote,
       "line",
       formatted("%.1f %% of the lidar's bytes were damaged or skipped", 100 * share),
       {"use a shorter or shielded cable, away from motors, and a stable 5 V supply"}});
}

/// Deskewing needs readings: below the minimum, predicted poses may be wrong; below the good rate,
/// covariances of fixes in motion are too small (core/odometry/README.md).
constexpr double kMinReadings_hz = 10;
constexpr double kGoodReadings_hz = 20;

void add_reading_rate(const Patient& patient, std::vector<Finding>& findings) {
  const std::optional<double> hz = patient.daemon.odometry_hz;
  if (!hz || *hz >= kGoodReadings_hz) return;
  if (*hz <= 0) {
    if (patient.daemon.status && !patient.daemon.status->odometry_hint.empty()) return;
    findings.push_back({Verdict::kNote,
                        "odometry",
                        "is configured, but no reading arrives",
                        {"start the program that sends ODOMETRY to control.sock"}});
    return;
  }
  const bool is_wrong = *hz < kMinReadings_hz;
  const std::string mend =
      patient.config.odometry.source == settings::OdometrySource::kKernel
          ? "advanced.odometry.kernel.rate: 50"
          : "send ODOMETRY 50 times a second, with wheels and gyro in one line";
  findings.push_back({is_wrong ? Verdict::kWrong : Verdict::kNote,
                      "odometry",
                      formatted("%.1f readings a second: ", *hz) +
                          (is_wrong ? "too few, predicted poses in motion may be wrong"
                                    : "few, the covariance of fixes in motion is too small"),
                      {mend}});
}

void add_hint(const message::ParsedStatus& status, std::vector<Finding>& findings) {
  if (status.odometry_hint.empty()) return;
  findings.push_back({Verdict::kWrong,
                      "odometry",
                      status.odometry_state + ": " + status.odometry_hint,
                      {"see README.md, \"Odometry\", for the fields of a line"}});
}

/// What only the daemon can know, from many scans; its hint says what to do. The lidar's faults and
/// absent readings have findings of their own.
void add_fault(const message::ParsedStatus& status, std::vector<Finding>& findings) {
  if (status.faults.empty()) return;
  const std::string& fault = status.faults.front();
  if (fault == status.lidar_fault || status.hint == status.odometry_hint) return;
  const char* subject = fault.find("map") != fault.npos ? "map"
                        : fault.starts_with("mount")    ? "mount"
                        : fault.starts_with("range")    ? "ranges"
                        : fault.ends_with("-file")      ? "files"
                                                        : "odometry";
  findings.push_back({Verdict::kWrong, subject, status.hint, {}});
}

}  // namespace

std::vector<Finding> check_daemon(const Patient& patient) {
  const DaemonView& daemon = patient.daemon;
  // EAGAIN: the socket's queue of pending connections is full.
  const bool hangs = daemon.connect_errno == EAGAIN;
  if (daemon.connect_errno != 0 && !hangs) return unreachable(patient);
  if (hangs || daemon.version.empty()) {
    return {
        {Verdict::kWrong,
         "daemon",
         "accepts connections but sends nothing: it hangs, or systemd holds the socket of a daemon "
         "that cannot start",
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
         {"see drivers/odometry/README.md for pins, overlays and names"}});
  }
  add_hint(*daemon.status, findings);
  add_reading_rate(patient, findings);
  add_fault(*daemon.status, findings);
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
             caller.name + " is in the group cornerd, but this session began before that",
             {"log out and in again"}}};
  }
  return {{Verdict::kNote,
           "control",
           caller.name + " may read poses but not send requests (odometry, SET_POSE, RELOCALIZE)",
           {"sudo usermod -aG cornerd " + caller.name + ", then log out and in again"}}};
}

}  // namespace cornerd::tool
