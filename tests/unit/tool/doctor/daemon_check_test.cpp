// SPDX-License-Identifier: MIT
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cerrno>
#include <utility>

#include "doctor/stand_in.hpp"
#include "tool/doctor/checks.hpp"

namespace cornerd::tool {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

class CheckDaemon : public testing::Test {
 protected:
  CheckDaemon() {
    daemon().version = "1.2.3";
    daemon().status.emplace();
    daemon().status->lidar_state = "running";
  }
  DaemonView& daemon() { return stand_in_.patient.daemon; }
  void see(std::uint64_t fixes, std::uint64_t ambiguous, std::uint64_t lost) {
    daemon().poses = {fixes, 0, 0, ambiguous, lost};
  }
  StandIn stand_in_;
};

TEST_F(CheckDaemon, RunningLidar_IsGood) {
  message::ParsedStatus& status = *daemon().status;
  status.lidar_model = "A1M8";
  status.lidar_firmware = "1.29";
  status.lidar_health = "good";
  status.rate_hz = 7.125;
  EXPECT_THAT(
      check_daemon(stand_in_.patient),
      ElementsAre(
          Finds(Verdict::kGood, "daemon", "cornerd 1.2.3 answers on /run/cornerd/pose.sock"),
          Finds(Verdict::kGood, "lidar", "running, A1M8 firmware 1.29, health good, 7.1 scans/s")));
}

TEST_F(CheckDaemon, LidarFault_QuotesDaemonDetail) {
  message::ParsedStatus& status = *daemon().status;
  status.lidar_state = "faulty";
  status.lidar_fault = "dead-laser";
  status.lidar_detail = "/dev/rplidar: its head turns, but nothing returns";
  EXPECT_THAT(check_daemon(stand_in_.patient)[1],
              Finds(Verdict::kWrong, "lidar", "faulty, dead-laser: /dev/rplidar: its head turns"));
  EXPECT_THAT(check_poses(stand_in_.patient), IsEmpty());
}

TEST_F(CheckDaemon, AdviceToRunDoctor_IsOmitted) {
  message::ParsedStatus& status = *daemon().status;
  status.lidar_state = "opening";
  status.lidar_detail = "/dev/rplidar: held; waiting for it. `sudo cornerctl doctor` says by whom";
  EXPECT_EQ(check_daemon(stand_in_.patient)[1].what, "opening: /dev/rplidar: held; waiting for it");
}

TEST_F(CheckDaemon, DamagedBytesAboveLimit_AreNoted) {
  daemon().status->counters = {{"bytes", 10000}, {"skipped_bytes", 100}};
  EXPECT_THAT(check_daemon(stand_in_.patient), SizeIs(2));
  daemon().status->counters = {{"bytes", 10000}, {"skipped_bytes", 250}};
  EXPECT_THAT(check_daemon(stand_in_.patient)[2], Finds(Verdict::kNote, "line", "2.5 %"));
}

TEST_F(CheckDaemon, AbsentOdometrySensor_IsNamed) {
  daemon().status->odometry_sensors = {{"gyro", "running", ""},
                                       {"left", "absent", "no counter 48300180.counter"}};
  EXPECT_THAT(check_daemon(stand_in_.patient)[2],
              Finds(Verdict::kWrong, "odometry", "left is absent: no counter 48300180.counter"));
}

TEST_F(CheckDaemon, LowReadingRate_IsReported) {
  daemon().odometry_hz = 49.8;
  EXPECT_THAT(check_daemon(stand_in_.patient), SizeIs(2));
  daemon().odometry_hz = 12;
  EXPECT_THAT(check_daemon(stand_in_.patient)[2],
              Finds(Verdict::kNote, "odometry",
                    "12.0 readings a second: few, the covariance of fixes in motion is too small"));
  daemon().odometry_hz = 4.9;
  const Finding few = check_daemon(stand_in_.patient)[2];
  EXPECT_THAT(few, Finds(Verdict::kWrong, "odometry", "4.9 readings a second: too few"));
  EXPECT_THAT(few.remedies, ElementsAre(HasSubstr("send ODOMETRY 50 times a second")));
  stand_in_.patient.config.odometry.source = settings::OdometrySource::kKernel;
  EXPECT_THAT(check_daemon(stand_in_.patient)[2].remedies,
              ElementsAre("advanced.odometry.kernel.rate: 50"));
  daemon().odometry_hz = 0;
  EXPECT_THAT(check_daemon(stand_in_.patient)[2],
              Finds(Verdict::kNote, "odometry", "no reading arrives"));
}

TEST_F(CheckDaemon, OdometryHint_IsQuotedOnce) {
  daemon().status->odometry_state = "absent";
  daemon().status->odometry_hint = "lines lack left and right";
  daemon().odometry_hz = 0;
  const auto found = check_daemon(stand_in_.patient);
  EXPECT_THAT(found, SizeIs(3));
  EXPECT_THAT(found[2], Finds(Verdict::kWrong, "odometry", "absent: lines lack left and right"));
}

TEST_F(CheckDaemon, MapThatDoesNotFit_IsQuotedFromTheDaemon) {
  daemon().status->faults = {"map-mismatch"};
  daemon().status->hint = "98 of the last 100 scans fit nowhere in the map \"hall\"";
  EXPECT_THAT(check_daemon(stand_in_.patient).back(),
              Finds(Verdict::kWrong, "map", "fit nowhere in the map \"hall\""));
  daemon().status->faults = {"odometry-unhealthy"};
  daemon().status->hint = "the odometry contradicts the lidar";
  EXPECT_THAT(check_daemon(stand_in_.patient).back(),
              Finds(Verdict::kWrong, "odometry", "contradicts the lidar"));
}

TEST_F(CheckDaemon, NoListener_HasRemedyForItsCause) {
  daemon() = {};
  daemon().connect_errno = ENOENT;
  EXPECT_THAT(check_daemon(stand_in_.patient)[0].remedies, ElementsAre(HasSubstr("install")));
  stand_in_.write("/lib/systemd/system/cornerd.service");
  const auto found = check_daemon(stand_in_.patient);
  ASSERT_THAT(found, ElementsAre(Finds(Verdict::kWrong, "daemon", "does not run")));
  EXPECT_THAT(found[0].remedies,
              ElementsAre("sudo systemctl start cornerd", HasSubstr("journalctl")));
  stand_in_.run_process(31, "cornerd");
  EXPECT_THAT(
      check_daemon(stand_in_.patient)[0],
      Finds(Verdict::kWrong, "daemon", "cornerd runs (process 31), but not with the socket"));
  daemon().connect_errno = EACCES;
  EXPECT_THAT(check_daemon(stand_in_.patient)[0], Finds(Verdict::kWrong, "daemon", "not enter"));
}

TEST_F(CheckDaemon, NoAnswer_DaemonHangs) {
  daemon() = {};
  EXPECT_THAT(check_daemon(stand_in_.patient)[0], Finds(Verdict::kWrong, "daemon", "it hangs"));
  daemon().connect_errno = EAGAIN;
  EXPECT_THAT(check_daemon(stand_in_.patient)[0], Finds(Verdict::kWrong, "daemon", "it hangs"));
}

TEST_F(CheckDaemon, HalfOfPosesAreFixes_IsGood) {
  see(5, 2, 3);
  EXPECT_THAT(check_poses(stand_in_.patient),
              ElementsAre(Finds(Verdict::kGood, "poses", "5 fix, 2 ambiguous, 3 lost")));
  see(0, 0, 0);
  EXPECT_THAT(check_poses(stand_in_.patient), ElementsAre(Finds(Verdict::kWrong, "poses", "none")));
}

TEST_F(CheckDaemon, WholeRun_IsJudged) {
  see(10, 0, 0);
  daemon().status->counters = {{"poses_fix", 40}, {"poses_lost", 900}};
  EXPECT_THAT(
      check_poses(stand_in_.patient),
      ElementsAre(Finds(Verdict::kWrong, "poses", "10 fix; since the start: 40 fix, 900 lost")));
  see(1, 0, 9);
  daemon().status->counters = {{"poses_fix", 900}, {"poses_lost", 40}};
  EXPECT_THAT(check_poses(stand_in_.patient),
              ElementsAre(Finds(Verdict::kGood, "poses", "900 fix")));
}

TEST_F(CheckDaemon, FaultsOfTheDaemon_AreQuotedWithTheirSubject) {
  see(10, 0, 0);
  for (const auto& [fault, subject] :
       {std::pair("mount-theta", "mount"), {"wheels-swapped", "odometry"}, {"map-scale", "map"}}) {
    daemon().status->faults = {fault};
    daemon().status->hint = "so it is";
    EXPECT_THAT(check_daemon(stand_in_.patient),
                testing::Contains(Finds(Verdict::kWrong, subject, "so it is")));
  }
}

TEST_F(CheckDaemon, ZombieOfADaemon_DoesNotRun) {
  daemon().connect_errno = ENOENT;
  stand_in_.write("/proc/12/comm", "cornerd\n");
  stand_in_.write("/proc/12/stat", "12 (cornerd) S 1 12 12\n");
  EXPECT_THAT(check_daemon(stand_in_.patient),
              ElementsAre(Finds(Verdict::kWrong, "daemon", "cornerd runs (process 12)")));
  stand_in_.write("/proc/12/stat", "12 (cornerd) Z 1 12 12\n");
  EXPECT_THAT(check_daemon(stand_in_.patient),
              ElementsAre(Finds(Verdict::kWrong, "daemon", "does not run")));
}

TEST_F(CheckDaemon, FewBytes_SayNothingOfTheLine) {
  daemon().status->counters = {{"bytes", 2000}, {"skipped_bytes", 1000}};
  EXPECT_THAT(check_daemon(stand_in_.patient),
              testing::Not(testing::Contains(Finds(Verdict::kNote, "line", ""))));
}

TEST_F(CheckDaemon, LostAndAmbiguous_HaveDifferentRemedies) {
  see(1, 0, 9);
  EXPECT_THAT(check_poses(stand_in_.patient)[0].remedies[0], HasSubstr("map is right"));
  see(1, 8, 1);
  EXPECT_THAT(check_poses(stand_in_.patient)[0].remedies[0], HasSubstr("look-alike"));
}

}  // namespace

namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

TEST(CheckControl, CallerOutsideGroup_IsNoted) {
  StandIn stand_in;
  EXPECT_THAT(check_control(stand_in.patient), IsEmpty());
  stand_in.write("/etc/passwd", "ada:x:1000:1000::/:/bin/sh\n");
  stand_in.write("/etc/group", "cornerd:x:990:\n");
  const auto found = check_control(stand_in.patient);
  ASSERT_THAT(found, ElementsAre(Finds(Verdict::kNote, "control", "not send requests")));
  EXPECT_THAT(found[0].remedies, ElementsAre(HasSubstr("usermod -aG cornerd ada")));
  stand_in.write("/etc/group", "cornerd:x:990:ada\n");
  EXPECT_THAT(check_control(stand_in.patient),
              ElementsAre(Finds(Verdict::kNote, "control", "began before")));
  stand_in.patient.caller.gids.insert(990);
  EXPECT_THAT(check_control(stand_in.patient),
              ElementsAre(Finds(Verdict::kGood, "control", "may send requests")));
  stand_in.patient.caller = {"root", 0, {0}};
  EXPECT_THAT(check_control(stand_in.patient), IsEmpty());
}

}  // namespace
}  // namespace cornerd::tool
