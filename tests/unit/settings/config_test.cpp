// SPDX-License-Identifier: MIT
#include "settings/config.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <set>
#include <string>

#include "error_of.hpp"
#include "settings/config_table.hpp"

namespace cornerd::settings {
namespace {

using ::testing::EndsWith;
using ::testing::HasSubstr;

constexpr const char* kFile = "/etc/cornerd/cornerd.json";

Config parse(std::string_view text) { return parse_config(text, kFile); }
/// A config with a map and these overrides.
Config overridden(const std::vector<std::string>& overrides) {
  return parse_config(R"({"map": "/m"})", kFile, overrides);
}

TEST(Config, MapAlone_IsEnough) {
  const Config config = parse(R"({"map": "/maps/a.json"})");
  EXPECT_EQ(config.map, "/maps/a.json");
  EXPECT_EQ(config.lidar.driver, DriverKind::kRplidar);
  EXPECT_EQ(config.lidar.baud, 0u) << "auto";
  EXPECT_EQ(config.socket.pose, "/run/cornerd/pose.sock");
}

TEST(Config, Keys_SetTheirMembers) {
  const Config config = parse(R"({
    // a comment
    "lidar": {"driver": "replay", "device": "/dev/ttyS4", "file": "/r.bin", "speed": 2.5,
              "loop": true, "mount": {"x": 0.1, "y": -0.2, "theta": 4, "inverted": true}},
    "map": "/m.json",
    "odometry": {"source": "socket", "wheel_radius": 0.03, "track": 0.2, "counts_per_turn": 48},
    "socket": {"pose": "/p.sock", "control": "/c.sock"},
    "advanced": {
      "lidar": {"baud": 460800, "mode": "Boost", "min_range": 0.2, "max_range": 6,
                "motor": "none", "bias": {"range_offset": 0.01}, "calibrate_online": false,
                "calibration_file": "/l.json"},
      "detector": {"sigma_offset": 0.05, "corner_tolerance": 0.3, "altbd": {"seed_samples": 4},
                   "extraction": {"occlusion_samples": 5}},
      "localizer": {"updates_per_scan": 4},
      "odometry": {"counter_max": 65535, "noise": {"wheel": 0.01},
                   "initial": {"left_scale": 0.02, "delay": -0.1},
                   "initial_sigma": {"gyro_bias": 0.1}, "max_extrapolation": 3,
                   "publish_predictions": true},
      "realtime": {"priority": 0, "lock_memory": false}}})");
  EXPECT_EQ(config.lidar.driver, DriverKind::kReplay);
  EXPECT_EQ(config.lidar.device, "/dev/ttyS4");
  EXPECT_EQ(config.lidar.file, "/r.bin");
  EXPECT_EQ(config.lidar.speed, 2.5);
  EXPECT_TRUE(config.lidar.loop);
  EXPECT_TRUE(config.lidar.mount.inverted);
  EXPECT_EQ(config.lidar.baud, 460800u);
  EXPECT_EQ(config.lidar.mode, "Boost");
  EXPECT_EQ(config.lidar.motor.kind, rplidar::MotorKind::kNone);
  EXPECT_EQ(config.lidar.calibration_file, "/l.json");
  EXPECT_EQ(config.odometry.source, OdometrySource::kSocket);
  EXPECT_EQ(config.socket.pose, "/p.sock");
  EXPECT_EQ(config.socket.control, "/c.sock");
  EXPECT_EQ(config.realtime.priority, 0);
  EXPECT_FALSE(config.realtime.lock_memory);

  const core::LocalizerConfig localizer = config.localizer();
  EXPECT_EQ(localizer.min_range_m, 0.2);
  EXPECT_EQ(localizer.max_range_m, 6);
  EXPECT_EQ(localizer.T_base_lidar.x_m, 0.1);
  EXPECT_EQ(localizer.T_base_lidar.y_m, -0.2);
  EXPECT_NEAR(localizer.T_base_lidar.theta_rad, 4 - core::kTwoPi, 1e-12);
  EXPECT_EQ(localizer.bias.range_offset_m, 0.01);
  EXPECT_FALSE(localizer.calibrate_online);
  EXPECT_EQ(localizer.updates_per_scan, 4U);
  EXPECT_EQ(localizer.detector.sigma_offset, 0.05);
  EXPECT_EQ(localizer.detector.corner_tolerance_m, 0.3);
  EXPECT_EQ(localizer.detector.altbd.seed_samples, 4U);
  EXPECT_EQ(localizer.detector.extraction.occlusion_samples, 5U);
  const core::OdometryConfig& odometry = localizer.odometry;
  EXPECT_TRUE(odometry.enabled);
  EXPECT_EQ(odometry.geometry.wheel_radius_m, 0.03);
  EXPECT_EQ(odometry.geometry.track_m, 0.2);
  EXPECT_EQ(odometry.geometry.counts_per_turn, 48);
  EXPECT_EQ(odometry.geometry.counter_max, 65535);
  EXPECT_EQ(odometry.noise.wheel_m_per_sqrt_m, 0.01);
  EXPECT_EQ(odometry.noise.gyro_bias_rad_s, 0.1);
  EXPECT_EQ(odometry.initial.left_scale, 0.02);
  EXPECT_EQ(odometry.initial.delay_s, -0.1);
  EXPECT_EQ(odometry.max_extrapolation_s, 3);
  EXPECT_TRUE(odometry.publish_predictions);
}

TEST(Config, OldPointerOfAnOverride_IsRefusedWithItsNewName) {
  EXPECT_THAT(error_of([] { overridden({"/odometry/bridge=3"}); }),
              EndsWith(": /odometry/bridge: moved; write /advanced/odometry/max_extrapolation "
                       "instead"));
}

TEST(ConfigTable, PointersOldAndNew_AreUnique) {
  Config config;
  std::set<std::string> pointers;
  for (const Key& key : config_table(config)) {
    EXPECT_TRUE(pointers.insert(key.pointer).second) << key.pointer;
    const std::string old = key.old_pointer();
    EXPECT_TRUE(old.empty() || pointers.insert(old).second) << old;
  }
}

TEST(Config, NoMapRequired_IsReadWithoutMap) {
  EXPECT_NO_THROW(parse_config("{}", kFile, {}, /*require_map=*/false));
}

TEST(Config, KernelOdometry_SetsDevicesAndIgnoresCounterMax) {
  const Config config = parse(R"({"map": "/m", "odometry": {"source": "kernel"}, "advanced":
    {"odometry": {"counter_max": 65535, "kernel": {
      "left": {"counter": "a", "count": 1, "reversed": true}, "right": {"counter": "a"},
      "gyro": {"device": "none", "axis": "x", "reversed": true}, "rate": 100, "sysfs": "/t"}}}})");
  const drivers::KernelOdometryConfig& kernel = config.odometry.kernel;
  EXPECT_EQ(config.odometry.source, OdometrySource::kKernel);
  EXPECT_EQ(kernel.left.counter, "a");
  EXPECT_EQ(kernel.left.count, 1);
  EXPECT_TRUE(kernel.left.reversed);
  EXPECT_FALSE(kernel.right.reversed);
  EXPECT_EQ(kernel.gyro.device, "");
  EXPECT_EQ(kernel.gyro.axis, 'x');
  EXPECT_TRUE(kernel.gyro.reversed);
  EXPECT_EQ(kernel.rate_hz, 100);
  EXPECT_EQ(kernel.sysfs, "/t");
  EXPECT_TRUE(config.localizer().odometry.enabled);
  EXPECT_EQ(config.localizer().odometry.geometry.counter_max, 0);
}

TEST(Config, MotorObject_SelectsALineOfTheBoard) {
  const Config gpio =
      overridden({R"(/advanced/lidar/motor={"kind": "gpio", "path": "/sys/gpio60"})"});
  EXPECT_EQ(gpio.lidar.motor.kind, rplidar::MotorKind::kGpio);
  EXPECT_EQ(gpio.lidar.motor.path, "/sys/gpio60");
  const Config pwm = overridden(
      {R"(/advanced/lidar/motor={"kind": "pwm", "path": "/p", "duty": 0.6, "period": 1e-4})"});
  EXPECT_EQ(pwm.lidar.motor.kind, rplidar::MotorKind::kPwm);
  EXPECT_EQ(pwm.lidar.motor.duty, 0.6);
  EXPECT_EQ(pwm.lidar.motor.period_s, 1e-4);
}

TEST(Config, SpeedMax_IsZero) { EXPECT_EQ(overridden({"/lidar/speed=max"}).lidar.speed, 0); }

TEST(Config, RelativePath_StartsAtTheFile) {
  const Config config = parse(R"({"map": "../maps/a.json", "lidar": {"file": "r.bin"}})");
  EXPECT_EQ(config.map, "/etc/maps/a.json");
  EXPECT_EQ(config.lidar.file, "/etc/cornerd/r.bin");
}

TEST(Config, RelativePathOfAnOverride_StartsAtTheWorkingDirectory) {
  const Config config = parse_config(R"({"map": "a.json"})", kFile, {"/map=b.json"});
  EXPECT_EQ(config.map, std::filesystem::current_path() / "b.json");
}

TEST(Config, TextWithoutAFile_KeepsItsPaths) {
  EXPECT_EQ(parse_config(R"({"map": "a.json"})", "").map, "a.json");
}

TEST(Config, TooLongSocketPath_IsNamed) {
  EXPECT_THAT(error_of([] { overridden({"/socket/pose=/" + std::string(107, 'x')}); }),
              HasSubstr("/socket/pose: a socket's path has at most 107 bytes"));
}

TEST(Config, Override_IsCheckedAsTheFile) {
  const Config config = overridden({"/advanced/lidar/mode=Standard", "/lidar/mount/x=0.5"});
  EXPECT_EQ(config.lidar.mode, "Standard");
  EXPECT_EQ(config.lidar.mount.x_m, 0.5);
  EXPECT_THAT(error_of([] { overridden({"/lidar/spee=2"}); }),
              HasSubstr("/lidar/spee: unknown key; did you mean \"speed\"?"));
}

TEST(Config, UnreadableFile_IsNamed) {
  EXPECT_EQ(error_of([] { load_config("/nowhere/cornerd.json"); }),
            "/nowhere/cornerd.json: cannot be opened: No such file or directory");
  EXPECT_EQ(error_of([] { load_config("/tmp"); }), "/tmp: is a folder");
  EXPECT_THAT(error_of([] { load_config("/dev/zero"); }), HasSubstr("longer than"));
}

TEST(NeedsRestart, KeysReadAtTheStart_AreListed) {
  EXPECT_EQ(needs_restart(
                overridden({}),
                overridden({"/lidar/device=/dev/ttyS1", "/advanced/odometry/kernel/right/count=1",
                            "/advanced/lidar/motor=none", "/advanced/realtime/priority=0"})),
            "/lidar/device, /advanced/lidar/motor, /advanced/odometry/kernel/right/count, "
            "/advanced/realtime/priority");
}

TEST(NeedsRestart, KeysAppliedByAReload_AreNotListed) {
  EXPECT_EQ(needs_restart(overridden({}), overridden({"/map=/another.json", "/lidar/mount/x=1",
                                                      "/advanced/odometry/max_extrapolation=3"})),
            "");
}

TEST(OneLine, ControlCharacters_AreQuestionMarks) {
  EXPECT_EQ(one_line("a\x1b[2J\nb\x7f"), "a?[2J?b?");
  EXPECT_EQ(one_line("K\xc3\xbc"
                     "che \xff\xc3(\xe5\x8f\xb0 \xe5\x8f"),
            "K\xc3\xbc"
            "che ?"
            "?(\xe5\x8f\xb0 ?"
            "?");
}

TEST(SettingsError, AnyText_IsOneLine) {
  EXPECT_EQ(error_of([] { throw SettingsError("a\nb", "/c\td", "e\x1b"); }), "a?b: /c?d: e?");
}

}  // namespace
}  // namespace cornerd::settings
