// SPDX-License-Identifier: MIT
#include "settings/config.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "error_of.hpp"

namespace cornerd::settings {
namespace {

using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::StartsWith;

constexpr const char* kFile = "/etc/cornerd/cornerd.json";

Config parse(std::string_view text) { return parse_config(text, kFile); }
std::string config_error(std::string_view text) {
  return error_of([text] { parse(text); });
}

TEST(Config, MapAlone_IsEnough) {
  const Config config = parse(R"({"map": "/maps/a.json"})");
  EXPECT_EQ(config.map, "/maps/a.json");
  EXPECT_EQ(config.lidar.driver, DriverKind::kRplidar);
  EXPECT_EQ(config.lidar.baud, 115200u);
  EXPECT_EQ(config.socket.pose, "/run/cornerd/pose.sock");
}

TEST(Config, EveryKey_ReachesItsMember) {
  const Config config = parse(R"({
    // a comment
    "lidar": {"driver": "replay", "device": "/dev/ttyS4", "baud": 460800, "mode": "Boost",
              "min_range": 0.2, "max_range": 6, "file": "/r.bin", "speed": 2.5, "loop": true,
              "mount": {"x": 0.1, "y": -0.2, "theta": 4, "inverted": true}, "motor": "none"},
    "map": "/m.json",
    "detector": {"method": "lt", "sigma_offset": 0.05, "corner_tolerance": 0.3},
    "odometry": {"source": "socket", "wheel_radius": 0.03, "track": 0.2, "counts_per_turn": 48,
                 "ceiling": 65535, "mode": "weighted", "factors": {"encoder": 1.1, "gyro": 0.9},
                 "dead_band": 0.01, "noise": {"wheel": 0.01, "gyro_bias": 0.1}, "bridge": 3},
    "socket": {"pose": "/p.sock", "control": "/c.sock"},
    "realtime": {"priority": 0, "lock_memory": false}})");
  EXPECT_EQ(config.lidar.driver, DriverKind::kReplay);
  EXPECT_EQ(config.lidar.device, "/dev/ttyS4");
  EXPECT_EQ(config.lidar.baud, 460800u);
  EXPECT_EQ(config.lidar.mode, "Boost");
  EXPECT_EQ(config.lidar.min_range_m, 0.2);
  EXPECT_EQ(config.lidar.max_range_m, 6);
  EXPECT_EQ(config.lidar.file, "/r.bin");
  EXPECT_EQ(config.lidar.speed, 2.5);
  EXPECT_TRUE(config.lidar.loop);
  EXPECT_EQ(config.lidar.mount.x_m, 0.1);
  EXPECT_EQ(config.lidar.mount.y_m, -0.2);
  EXPECT_TRUE(config.lidar.mount.inverted);
  EXPECT_EQ(config.lidar.motor.kind, MotorKind::kNone);
  EXPECT_EQ(config.detector.method, core::Method::kLineTracking);
  EXPECT_EQ(config.detector.sigma_offset, 0.05);
  EXPECT_EQ(config.detector.corner_tolerance_m, 0.3);
  EXPECT_EQ(config.odometry.core.geometry.wheel_radius_m, 0.03);
  EXPECT_EQ(config.odometry.core.geometry.track_m, 0.2);
  EXPECT_EQ(config.odometry.core.geometry.counts_per_turn, 48);
  EXPECT_TRUE(config.localizer().odometry.enabled);
  EXPECT_EQ(config.odometry.core.geometry.counter_max, 65535);
  EXPECT_EQ(config.odometry.core.mode, core::HeadingSource::kWeighted);
  EXPECT_EQ(config.odometry.core.paper.encoder_factor, 1.1);
  EXPECT_EQ(config.odometry.core.paper.gyro_factor, 0.9);
  EXPECT_EQ(config.odometry.core.paper.dead_band_rad, 0.01);
  EXPECT_EQ(config.odometry.core.noise.wheel_m_per_sqrt_m, 0.01);
  EXPECT_EQ(config.odometry.core.noise.gyro_bias_rad_s, 0.1);
  EXPECT_EQ(config.odometry.core.max_extrapolation_s, 3);
  EXPECT_EQ(config.socket.pose, "/p.sock");
  EXPECT_EQ(config.socket.control, "/c.sock");
  EXPECT_EQ(config.realtime.priority, 0);
  EXPECT_FALSE(config.realtime.lock_memory);

  const core::LocalizerConfig localizer = config.localizer();
  EXPECT_EQ(localizer.min_range_m, 0.2);
  EXPECT_EQ(localizer.max_range_m, 6);
  EXPECT_EQ(localizer.T_base_lidar.x_m, 0.1);
  EXPECT_NEAR(localizer.T_base_lidar.theta_rad, 4 - core::kTwoPi, 1e-12);
  EXPECT_EQ(localizer.detector.method, core::Method::kLineTracking);
}

TEST(Config, UnknownKey_NamesFilePointerAndTheLikelyOne) {
  EXPECT_EQ(config_error(R"({"map": "/m", "lidar": {"devise": "/dev/ttyS1"}})"),
            "/etc/cornerd/cornerd.json: /lidar/devise: unknown key; did you mean \"device\"?");
  EXPECT_THAT(config_error(R"({"map": "/m", "Lidar": {}})"), HasSubstr("mean \"lidar\"?"));
  EXPECT_THAT(config_error(R"({"map": "/m", "socket": {"port": 1}})"), HasSubstr("/socket/port"));
}

TEST(Config, UnknownKeyLikeNoOther_ListsWhatThereIs) {
  EXPECT_THAT(config_error(R"({"map": "/m", "realtime": {"colour": 1}})"),
              EndsWith("known here: priority, lock_memory"));
}

TEST(OneLine, ControlCharacters_AreQuestionMarks) {
  EXPECT_EQ(one_line("a\x1b[2J\nb\x7f"), "a?[2J?b?");
}

TEST(Config, SpeedThatNoPortHas_IsRefusedWithThoseThatItHas) {
  EXPECT_THAT(config_error(R"({"map": "/m", "lidar": {"baud": 115201}})"),
              EndsWith("/lidar/baud: must be one of 9600, 19200, 38400, 57600, 115200, 230400, "
                       "460800, 921600, 1000000"));
}

TEST(Config, WrongType_IsNamed) {
  EXPECT_THAT(config_error(R"({"map": 3})"), EndsWith("/map: must be a string"));
  EXPECT_THAT(config_error(R"({"map": "/m", "lidar": []})"), EndsWith("/lidar: must be an object"));
  EXPECT_THAT(config_error(R"({"map": "/m", "lidar": {"baud": "fast"}})"),
              EndsWith("/lidar/baud: must be a number"));
  EXPECT_THAT(config_error(R"({"map": "/m", "lidar": {"baud": 115200.5}})"),
              EndsWith("/lidar/baud: must be a whole number"));
  EXPECT_THAT(config_error(R"({"map": "/m", "realtime": {"lock_memory": 1}})"),
              EndsWith("must be true or false"));
  EXPECT_THAT(config_error(R"({"map": "/m", "lidar": {"mount": {"x": null}}})"),
              HasSubstr("/lidar/mount/x"));
  EXPECT_THAT(config_error("[]"), EndsWith("cornerd.json: must be an object"));
}

TEST(Config, ValueOutOfRange_IsNamedWithItsLimits) {
  EXPECT_THAT(config_error(R"({"map": "/m", "realtime": {"priority": 100}})"),
              EndsWith("/realtime/priority: must be from 0 to 99, not 100"));
  EXPECT_THAT(config_error(R"({"map": "/m", "lidar": {"mount": {"theta": 90}}})"),
              HasSubstr("/lidar/mount/theta: must be from"));
  EXPECT_THAT(config_error(R"({"map": "/m", "odometry": {"track": 0}})"),
              HasSubstr("/odometry/track"));
  EXPECT_THAT(config_error(R"({"map": ""})"), EndsWith("/map: must not be empty"));
}

TEST(Config, KernelOdometry_NamesItsDevicesAndGoesByTheirCeilings) {
  const Config config = parse(R"({"map": "/m", "odometry": {"source": "kernel", "ceiling": 65535,
    "kernel": {"left": {"counter": "a", "count": 1, "reversed": true}, "right": {"counter": "a"},
               "gyro": {"device": "none", "axis": "x", "reversed": true}, "rate": 100,
               "sysfs": "/tree"}}})");
  const KernelOdometryConfig& kernel = config.odometry.kernel;
  EXPECT_EQ(config.odometry.source, OdometrySource::kKernel);
  EXPECT_EQ(kernel.left.counter, "a");
  EXPECT_EQ(kernel.left.count, 1);
  EXPECT_TRUE(kernel.left.reversed);
  EXPECT_FALSE(kernel.right.reversed);
  EXPECT_EQ(kernel.gyro.device, "");
  EXPECT_EQ(kernel.gyro.axis, 'x');
  EXPECT_TRUE(kernel.gyro.reversed);
  EXPECT_EQ(kernel.rate_hz, 100);
  EXPECT_EQ(kernel.sysfs, "/tree");
  EXPECT_TRUE(config.localizer().odometry.enabled);
  EXPECT_EQ(config.localizer().odometry.geometry.counter_max, 0);
}

TEST(Config, OneCounterForBothWheels_IsRefused) {
  EXPECT_THAT(config_error(R"({"map": "/m", "odometry": {"kernel": {"left": {"counter": "a"},
    "right": {"counter": "a"}}}})"),
              HasSubstr("/odometry/kernel/right: "));
}

TEST(Config, UpdatesPerTurn_ReachTheLocalizer) {
  EXPECT_EQ(
      parse(R"({"map": "/m", "localizer": {"updates_per_turn": 4}})").localizer().updates_per_scan,
      4U);
  EXPECT_THAT(config_error(R"({"map": "/m", "localizer": {"updates_per_turn": 0}})"),
              HasSubstr("/localizer/updates_per_turn"));
  EXPECT_THAT(config_error(R"({"map": "/m", "localizer": {"updates_per_turn": 17}})"),
              HasSubstr("/localizer/updates_per_turn"));
}

TEST(Config, UnknownChoice_ListsWhatThereIs) {
  EXPECT_THAT(config_error(R"({"map": "/m", "localizer": {"recognition": "guess"}})"),
              HasSubstr("/localizer/recognition"));
  EXPECT_THAT(config_error(R"({"map": "/m", "detector": {"method": "magic"}})"),
              EndsWith(R"(must be one of "altbd", "altbd-printed", "abd-iepf", "lt")"));
  EXPECT_THAT(config_error(R"({"map": "/m", "odometry": {"source": "wheels"}})"),
              EndsWith(R"(must be one of "none", "socket", "kernel")"));
}

TEST(Config, ValuesThatContradict_AreNamed) {
  EXPECT_THAT(config_error(R"({"map": "/m", "odometry": {"ceiling": 2}})"),
              HasSubstr("/odometry/ceiling: must be 0 (never wraps) or at least 3"));
  EXPECT_THAT(config_error(R"({"map": "/m", "lidar": {"min_range": 5, "max_range": 5}})"),
              HasSubstr("/lidar/max_range: must be more than min_range, 5"));
  EXPECT_THAT(config_error(R"({"map": "/m", "lidar": {"driver": "replay"}})"),
              HasSubstr("/lidar/file: is missing"));
  EXPECT_THAT(config_error(R"({"map": "/m", "socket": {"pose": "/a", "control": "/a"}})"),
              HasSubstr("/socket/control"));
}

TEST(Config, MissingMap_IsTheOnlyMissingKeyThatCounts) {
  EXPECT_THAT(config_error("{}"), StartsWith("/etc/cornerd/cornerd.json: /map: is missing"));
  EXPECT_NO_THROW(parse_config("{}", kFile, {}, /*require_map=*/false));
}

TEST(Config, MotorOnALineOfTheBoard_IsAnObject) {
  const Config gpio =
      parse(R"({"map": "/m", "lidar": {"motor": {"kind": "gpio", "path": "/sys/gpio60"}}})");
  EXPECT_EQ(gpio.lidar.motor.kind, MotorKind::kGpio);
  EXPECT_EQ(gpio.lidar.motor.path, "/sys/gpio60");
  const Config pwm = parse(
      R"({"map": "/m", "lidar": {"motor": {"kind": "pwm", "path": "/p", "duty": 0.6, "period": 1e-4}}})");
  EXPECT_EQ(pwm.lidar.motor.kind, MotorKind::kPwm);
  EXPECT_EQ(pwm.lidar.motor.duty, 0.6);
  EXPECT_EQ(pwm.lidar.motor.period_s, 1e-4);
}

TEST(Config, MotorThatCannotBe_IsNamed) {
  const auto motor_error = [](const std::string& motor) {
    return config_error(R"({"map": "/m", "lidar": {"motor": )" + motor + "}}");
  };
  EXPECT_THAT(motor_error("\"rts\""), EndsWith(R"(/lidar/motor: must be one of "dtr", "none")"));
  EXPECT_THAT(motor_error("7"), HasSubstr("/lidar/motor"));
  EXPECT_THAT(motor_error("{}"), EndsWith("/lidar/motor/kind: is missing"));
  EXPECT_THAT(motor_error(R"({"kind": "gpio"})"), EndsWith("/lidar/motor/path: is missing"));
  EXPECT_THAT(motor_error(R"({"kind": "gpio", "path": "/p", "duty": 1})"),
              HasSubstr("/lidar/motor/duty: unknown key"));
}

TEST(Config, SpeedMax_IsAsFastAsItGoes) {
  EXPECT_EQ(parse(R"({"map": "/m", "lidar": {"speed": "max"}})").lidar.speed, 0);
  EXPECT_THAT(config_error(R"({"map": "/m", "lidar": {"speed": "slow"}})"),
              HasSubstr("/lidar/speed"));
}

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

TEST(Config, SocketPathThatNoSocketCanHave_IsNamed) {
  EXPECT_THAT(
      config_error(R"({"map": "/m", "socket": {"pose": "/)" + std::string(107, 'x') + "\"}}"),
      HasSubstr("/socket/pose: a socket's path has at most 107 bytes"));
}

TEST(Config, Override_IsCheckedLikeTheFile) {
  const Config config =
      parse_config(R"({"map": "/m"})", kFile, {"/lidar/mode=Standard", "/lidar/mount/x=0.5"});
  EXPECT_EQ(config.lidar.mode, "Standard");
  EXPECT_EQ(config.lidar.mount.x_m, 0.5);
  EXPECT_THAT(error_of([] { parse_config(R"({"map": "/m"})", kFile, {"/lidar/spee=2"}); }),
              HasSubstr("/lidar/spee: unknown key; did you mean \"speed\"?"));
}

TEST(Config, FileThatCannotBeRead_IsNamed) {
  EXPECT_EQ(error_of([] { load_config("/nowhere/cornerd.json"); }),
            "/nowhere/cornerd.json: cannot be opened: No such file or directory");
  EXPECT_EQ(error_of([] { load_config("/tmp"); }), "/tmp: is a folder");
  EXPECT_THAT(error_of([] { load_config("/dev/zero"); }), HasSubstr("longer than"));
}

TEST(SettingsError, AnyText_IsOneLine) {
  EXPECT_EQ(error_of([] { throw SettingsError("a\nb", "/c\td", "e\x1b"); }), "a?b: /c?d: e?");
}

}  // namespace
}  // namespace cornerd::settings
