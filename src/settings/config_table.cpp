// SPDX-License-Identifier: MIT
#include "settings/config_table.hpp"

namespace cornerd::settings {
namespace {

/// A partial scan with fewer than a sixteenth of an A1's 800 samples holds too few corners.
constexpr std::size_t kMaxUpdatesPerScan = 16;

constexpr auto kOnRestart = Applies::kOnRestart;

constexpr Choice<DriverKind> kDrivers[] = {{"rplidar", DriverKind::kRplidar},
                                           {"ld", DriverKind::kLd},
                                           {"ydlidar", DriverKind::kYdlidar},
                                           {"replay", DriverKind::kReplay}};
constexpr Choice<OdometrySource> kOdometrySources[] = {{"none", OdometrySource::kNone},
                                                       {"socket", OdometrySource::kSocket},
                                                       {"kernel", OdometrySource::kKernel}};
constexpr Choice<char> kGyroAxes[] = {{"x", 'x'}, {"y", 'y'}, {"z", 'z'}};

void add_lidar_keys(std::vector<Key>& table, LidarConfig& lidar) {
  const auto add = [&table](Key key) { table.push_back(std::move(key)); };
  add({"/lidar/driver", choice(lidar.driver, kDrivers),
       "\"rplidar\": an RPLidar on a serial port. \"ld\": an LDROBOT LD06, LD19, STL-19P or "
       "STL-27L. \"ydlidar\": a YDLIDAR X2 or X4. \"replay\": a recording instead of a device.",
       kOnRestart});
  add({"/lidar/device", path(lidar.device),
       "The serial port. cornerd's udev rules name a USB adapter /dev/rplidar; the ports of a "
       "BeagleBone are /dev/ttyS1 and so on.",
       kOnRestart});
  add({"/lidar/file", path(lidar.file),
       "Driver \"replay\": the recording, .bin or .ndjson. All times are then the recording's.",
       kOnRestart});
  add({"/lidar/speed", replay_speed(lidar.speed),
       "Driver \"replay\": times real time; \"max\": without pauses.", kOnRestart});
  add({"/lidar/loop", boolean(lidar.loop),
       "Driver \"replay\": start again at the end of the recording.", kOnRestart});
  add({"/lidar/mount", {}, "Pose of the lidar on the robot."});
  add({"/lidar/mount/x", number(lidar.mount.x_m, -10, 10, " metres"),
       "Metres forward of the middle of the axle."});
  add({"/lidar/mount/y", number(lidar.mount.y_m, -10, 10, " metres"), "Metres to the left of it."});
  add({"/lidar/mount/theta", number(lidar.mount.theta_rad, -6.2832, 6.2832, " radians"),
       "Direction of the lidar's zero mark, radians counter-clockwise."});
  add({"/lidar/mount/inverted", boolean(lidar.mount.inverted), "The lidar hangs upside down.",
       kOnRestart});
  add({"/lidar/noise",
       {},
       "Standard deviations of a measurement. `cornerctl calibrate noise -o` writes this section. "
       "The defaults are those of the model (drivers/README.md), as far as the lidar says which it "
       "is; these are an RPLidar A1's."});
  add({"/lidar/noise/floor", number(lidar.noise.sensor.floor_m, kSigmaM.low, 0.1),
       "Of a range, metres: the larger of \"floor\" and \"share\" times the range."});
  add({"/lidar/noise/share", number(lidar.noise.sensor.share, 0, 0.1),
       "Of a range, as a share: 0.005 is half a percent."});
  add({"/lidar/noise/bearing", number(lidar.noise.sensor.bearing_rad, 0, 0.1),
       "Of a bearing, radians."});
  add({"/lidar/noise/ranges", sigma_table(lidar.noise.sensor.table),
       "A table in place of floor and share: [ { \"range\": 0.5, \"sigma\": 0.001 }, ... ]. Linear "
       "between its points; the first sigma before them, the last share behind them."});
  add({"/lidar/noise/wall", wall_model(lidar.noise.wall),
       "For simulated lidars only: error and sigma of a range before a straight wall, as "
       "polynomials of the ray and of the wall's distance. `calibrate noise FILE@METRES` fits "
       "them."});
}

void add_advanced_lidar_keys(std::vector<Key>& table, LidarConfig& lidar) {
  const auto add = [&table](Key key) { table.push_back(std::move(key)); };
  add({"/advanced/lidar/baud", baud_rate(lidar.baud),
       "\"auto\" tries those of the driver's models in turn: 115200, 256000, 460800 and 1000000 "
       "for "
       "\"rplidar\", 230400 and 921600 for \"ld\", 128000 and 115200 for \"ydlidar\".",
       kOnRestart});
  add({"/advanced/lidar/mode", text(lidar.mode),
       "The scan mode: \"auto\", or the device's own name of one: \"Standard\", \"Express\", "
       "\"Boost\", \"DenseBoost\". \"auto\" takes Express or a dense mode where the device has "
       "one: "
       "Boost samples twice as often as Express, but its ranges are coarser beyond half a metre.",
       kOnRestart});
  add({"/advanced/lidar/min_range", number(lidar.min_range_m, 0, 40),
       "Nearer returns are ignored, metres."});
  add({"/advanced/lidar/max_range", number(lidar.max_range_m, 0.1, 40),
       "Farther returns are ignored, metres."});
  add({"/advanced/lidar/motor", motor(lidar.motor),
       "The motor's switch. \"dtr\": the DTR line, as the A1's USB adapter wires it, and the "
       "request "
       "that a newer RPLidar takes instead. \"none\": the motor always runs. Or a line of the "
       "board, set up and writable: { \"kind\": \"gpio\", "
       "\"path\": \"/sys/class/gpio/gpio60\" }, or { \"kind\": \"pwm\", \"path\": "
       "\"/sys/class/pwm/pwmchip0/pwm0\", \"duty\": 1.0, \"period\": 4e-5 } (duty: share of the "
       "period that the line is high; period: seconds).",
       kOnRestart});
  add({"/advanced/lidar/bias", sensor_bias(lidar.bias),
       "Systematic errors: a range is measured as (1 + range_scale) times itself + range_offset "
       "(metres), at a bearing off by bearing_sine * sin(bearing) + bearing_cosine * cos(bearing) "
       "(radians), as an eccentric angle disc makes it. `cornerctl calibrate bias -o` writes it."});
  add({"/advanced/lidar/calibrate_online", boolean(lidar.calibrate_online),
       "Estimate the rest of the bias from scans at known poses, while the robot stands or wheels "
       "measure its motion.",
       Applies::kOnReload, "/lidar/learn_bias"});
  add({"/advanced/lidar/calibration_file", path(lidar.calibration_file),
       "Keeps that estimate for the next start, if it is the same device. Default: lidar.json in "
       "the service manager's state folder ($STATE_DIRECTORY); without that folder, no file.",
       kOnRestart, "/lidar/learned_file"});
}

void add_odometry_keys(std::vector<Key>& table, OdometryConfig& odometry) {
  const auto add = [&table](Key key) { table.push_back(std::move(key)); };
  core::DriveGeometry& geometry = odometry.core.geometry;
  add({"/odometry/source", choice(odometry.source, kOdometrySources),
       "\"none\": the lidar alone. \"socket\": ODOMETRY lines on control.sock or in a recording. "
       "\"kernel\": encoders and gyro on the board itself (drivers/odometry/README.md).",
       kOnRestart});
  add({"/odometry/wheel_radius", number(geometry.wheel_radius_m, 0.001, 10, " metres"), "Metres."});
  add({"/odometry/track", number(geometry.track_m, 0.001, 10, " metres"),
       "Distance between the wheels, metres."});
  add({"/odometry/counts_per_turn", number(geometry.counts_per_turn, 1, 1e7),
       "Encoder counts of one revolution of a wheel; they grow when the robot rolls forward."});
}

void add_advanced_odometry_keys(std::vector<Key>& table, OdometryConfig& odometry) {
  const auto add = [&table](Key key) { table.push_back(std::move(key)); };
  add({"/advanced/odometry/counter_max",
       integer(odometry.core.geometry.counter_max, 0, std::int64_t{1} << 53),
       "The highest count before the counter wraps to 0: 65535 for 16 bits, 4294967295 for 32; 0 "
       "for counts that never wrap. Source \"kernel\" reads it from the counters.",
       Applies::kOnReload, "/odometry/ceiling"});
  add({"/advanced/odometry/max_speed", number(odometry.core.limits.wheel_speed_m_s, 0.01, 100),
       "Of a wheel, m/s. Faster counts are rejected as invalid."});
  add({"/advanced/odometry/max_extrapolation", number(odometry.core.max_extrapolation_s, 0, 3600),
       "How long a pose is dead reckoned without the lidar (POSE.state \"predicted\"), seconds.",
       Applies::kOnReload, "/odometry/bridge"});
  add({"/advanced/odometry/publish_predictions", boolean(odometry.core.publish_predictions),
       "A POSE (\"predicted\") for every odometry reading too, with its age and growing "
       "covariance.",
       Applies::kOnReload, "/odometry/publish"});
  core::OdometryNoise& noise = odometry.core.noise;
  add({"/advanced/odometry/noise",
       {},
       "Process noise, as standard deviations; \"wheel\" and \"gyro\" hold until the lidar's fixes "
       "have shown the true ones."});
  add({"/advanced/odometry/noise/wheel", number(noise.wheel_m_per_sqrt_m, 1e-5, 1),
       "Of a wheel's travel after one metre, metres; after n metres sqrt(n) times as much."});
  add({"/advanced/odometry/noise/gyro", number(noise.gyro_rad_s_per_sqrt_hz, 1e-6, 1),
       "Of the gyro's rate, rad/s/sqrt(Hz). The default is three times an MPU-6050's data sheet, "
       "since robots vibrate."});
  add({"/advanced/odometry/noise/gyro_bias_walk", number(noise.bias_rad_s_per_sqrt_s, 0, 0.1),
       "Random walk of the gyro's bias, rad/s/sqrt(s)."});
  add({"/advanced/odometry/initial",
       {},
       "Initial calibration of the filter, which estimates all of it. `cornerctl calibrate "
       "odometry "
       "-o` writes it."});
  core::OdometryParameters& initial = odometry.core.initial;
  const auto scale = [](double& member) { return number(member, -0.5, 0.5); };
  const auto add_initial = [&add](const std::string& name, Value value, const char* text) {
    add({"/advanced/odometry/initial/" + name, std::move(value), text, Applies::kOnReload,
         "/odometry/start/" + name});
  };
  add_initial("left_scale", scale(initial.left_scale),
              "Error of the left wheel's radius, a share.");
  add_initial("right_scale", scale(initial.right_scale), "The same of the right wheel.");
  add_initial("track_scale", scale(initial.track_scale), "Error of the track, as a share.");
  add_initial("gyro_scale", scale(initial.gyro_scale), "Error of the gyro's scale, as a share.");
  add_initial("gyro_bias", scale(initial.gyro_bias_rad_s), "rad/s.");
  add_initial("delay", number(initial.delay_s, -kMaxInitialDelay_s, kMaxInitialDelay_s),
              "How much later than its measurement a reading is stamped, seconds.");
  add({"/advanced/odometry/initial_sigma",
       {},
       "Standard deviations of the initial calibration, in its units."});
  const auto add_sigma = [&add](const std::string& name, double& member, double high) {
    add({"/advanced/odometry/initial_sigma/" + name, number(member, 0, high), "",
         Applies::kOnReload, "/odometry/noise/" + name});
  };
  add_sigma("wheel_scale", noise.wheel_scale, 0.5);
  add_sigma("track_scale", noise.track_scale, 0.5);
  add_sigma("gyro_scale", noise.gyro_scale, 0.5);
  add_sigma("gyro_bias", noise.gyro_bias_rad_s, 1);
  add_sigma("delay", noise.delay_s, 0.1);
  drivers::KernelOdometryConfig& kernel = odometry.kernel;
  add({"/advanced/odometry/kernel", {}, "Source \"kernel\"."});
  for (const bool is_left : {true, false}) {
    drivers::EncoderConfig& encoder = is_left ? kernel.left : kernel.right;
    const std::string section =
        std::string("/advanced/odometry/kernel/") + (is_left ? "left" : "right");
    add({section + "/counter", text(encoder.counter),
         "The counter's name, as /sys/bus/counter/devices/counter*/name has it.", kOnRestart});
    add({section + "/count", integer(encoder.count, 0, 255), "Which of its counts.", kOnRestart});
    add({section + "/reversed", boolean(encoder.reversed),
         "It counts down when the robot rolls forward.", kOnRestart});
  }
  add({"/advanced/odometry/kernel/gyro/device", text(kernel.gyro.device),
       "Its name or label, as /sys/bus/iio/devices/iio:device*/name has it, or \"none\".",
       kOnRestart});
  add({"/advanced/odometry/kernel/gyro/axis", choice(kernel.gyro.axis, kGyroAxes),
       "The upright one.", kOnRestart});
  add({"/advanced/odometry/kernel/gyro/reversed", boolean(kernel.gyro.reversed),
       "That axis points down.", kOnRestart});
  add({"/advanced/odometry/kernel/rate", number(kernel.rate_hz, 5, 500), "Readings a second.",
       kOnRestart});
  add({"/advanced/odometry/kernel/sysfs", path(kernel.sysfs), "Where sysfs is mounted.",
       kOnRestart});
}

}  // namespace

std::vector<Key> config_table(Config& config) {
  std::vector<Key> table;
  const auto add = [&table](Key key) { table.push_back(std::move(key)); };
  add({"/map", path(config.map), "The map of the building. The only key without a default."});
  add({"/maps", named_maps(config.maps),
       "Floors or buildings to choose from: \"map\" is one of their names then, and so is "
       "SET_MAP's; or \"auto\": the scans of the first metres choose one of at most 16."});
  add_lidar_keys(table, config.lidar);
  add_odometry_keys(table, config.odometry);
  add({"/socket/pose", socket_path(config.socket.pose), "Clients read poses here.", kOnRestart});
  add({"/socket/control", socket_path(config.socket.control), "Clients send requests here.",
       kOnRestart});
  add({"/advanced", {}, "Few robots need the rest."});
  add_advanced_lidar_keys(table, config.lidar);
  add_advanced_odometry_keys(table, config.odometry);
  add({"/advanced/localizer/updates_per_scan",
       integer(config.updates_per_scan, 1, kMaxUpdatesPerScan),
       "While the pose is known: a POSE for each part of a scan, at the time of its last sample, "
       "before the whole scan's own. 4 gives one for each quarter of a revolution.",
       Applies::kOnReload, "/localizer/updates_per_turn"});
  add({"/advanced/localizer/learn_walls", boolean(config.learn_walls),
       "In a map that states a sigma: estimate each wall's offset across itself while the robot "
       "drives. `cornerctl map learned` writes the result into a map.",
       Applies::kOnReload});
  add({"/advanced/localizer/walls_folder", path(config.walls_folder),
       "Keeps that estimate for the next start, a file for each map: walls-HASH.json. Default: the "
       "service manager's state folder ($STATE_DIRECTORY); without that folder, no file.",
       kOnRestart});
  add_detector_keys(table, config.detector);
  add({"/advanced/realtime/priority", integer(config.realtime.priority, 0, 99),
       "SCHED_FIFO priority of the thread that reads the port; 0: none. A refusal is logged and "
       "has no other effect.",
       kOnRestart});
  add({"/advanced/realtime/lock_memory", boolean(config.realtime.lock_memory),
       "Keep the program's memory out of swap.", kOnRestart});
  return table;
}

}  // namespace cornerd::settings
