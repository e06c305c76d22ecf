// SPDX-License-Identifier: MIT
// One line a key: its name, the member that holds its default, its limits. config/cornerd.full.json
// says what each of them means.
#include "settings/config.hpp"

#include <sys/un.h>

#include <algorithm>
#include <utility>

#include "settings/detector_settings.hpp"
#include "settings/noise.hpp"
#include "settings/object_reader.hpp"
#include "settings/override.hpp"
#include "settings/sensor_bias.hpp"

namespace cornerd::settings {
namespace {

constexpr std::size_t kMaxConfigBytes = 1 << 20;
/// A part of a turn with fewer than a fiftieth of an A1's 800 samples tells nothing.
constexpr int kMaxUpdatesPerScan = 16;
constexpr std::size_t kMaxModeBytes = 64;
constexpr std::size_t kMaxDeviceNameBytes = 64;

constexpr Choice<DriverKind> kDrivers[] = {{"rplidar", DriverKind::kRplidar},
                                           {"replay", DriverKind::kReplay}};
constexpr Choice<MotorKind> kMotorsByName[] = {{"dtr", MotorKind::kDtr},
                                               {"none", MotorKind::kNone}};
constexpr Choice<MotorKind> kMotorsByPath[] = {{"gpio", MotorKind::kGpio},
                                               {"pwm", MotorKind::kPwm}};
constexpr Choice<OdometrySource> kOdometrySources[] = {{"none", OdometrySource::kNone},
                                                       {"socket", OdometrySource::kSocket},
                                                       {"kernel", OdometrySource::kKernel}};
constexpr Choice<char> kGyroAxes[] = {{"x", 'x'}, {"y", 'y'}, {"z", 'z'}};
constexpr Choice<core::HeadingSource> kOdometryModes[] = {
    {"filter", core::HeadingSource::kFilter},
    {"encoder", core::HeadingSource::kEncoder},
    {"gyro", core::HeadingSource::kGyro},
    {"mean", core::HeadingSource::kMean},
    {"weighted", core::HeadingSource::kWeighted}};

constexpr Choice<core::RecognitionMethod> kRecognitions[] = {
    {"patterns", core::RecognitionMethod::kPatterns}, {"paper", core::RecognitionMethod::kPaper}};

void read_mount(ObjectReader mount, MountConfig& config) {
  mount.number("x", config.x_m, {-10, 10});
  mount.number("y", config.y_m, {-10, 10});
  mount.number("theta", config.theta_rad, {-6.2832, 6.2832});
  mount.boolean("inverted", config.inverted);
  mount.finish();
}

/// A name, or an object where the motor hangs on a line of its own.
void read_motor(ObjectReader& lidar, MotorConfig& config) {
  const Json* value = lidar.find("motor");
  if (value == nullptr) return;
  if (!value->is_object()) {
    lidar.choice("motor", config.kind, kMotorsByName);
    return;
  }
  ObjectReader motor = lidar.object("motor");
  if (!motor.choice("kind", config.kind, kMotorsByPath)) motor.fail("kind", "is missing");
  if (!motor.path("path", config.path)) motor.fail("path", "is missing");
  if (config.kind == MotorKind::kPwm) {
    motor.number("duty", config.duty, {0, 1});
    motor.number("period", config.period_s, {1e-6, 1});
  }
  motor.finish();
}

void read_speed(ObjectReader& lidar, double& speed) {
  const Json* value = lidar.find("speed");
  if (value != nullptr && *value == "max") {
    speed = 0;
  } else {
    lidar.number("speed", speed, {0, 1000});
  }
}

void read_baud(ObjectReader& lidar, std::uint32_t& baud) {
  lidar.integer("baud", baud, kBaudRates.front(), kBaudRates.back());
  if (std::find(kBaudRates.begin(), kBaudRates.end(), baud) != kBaudRates.end()) return;
  std::string list;
  for (const std::uint32_t rate : kBaudRates)
    list += (list.empty() ? "" : ", ") + std::to_string(rate);
  lidar.fail("baud", "must be one of " + list);
}

void read_lidar(ObjectReader lidar, LidarConfig& config) {
  lidar.choice("driver", config.driver, kDrivers);
  lidar.path("device", config.device);
  read_baud(lidar, config.baud);
  lidar.text("mode", config.mode, kMaxModeBytes);
  lidar.number("min_range", config.min_range_m, {0, 40});
  lidar.number("max_range", config.max_range_m, {0.1, 40});
  read_noise(lidar.object("noise"), config.noise);
  read_bias(lidar.object("bias"), config.bias);
  lidar.boolean("learn_bias", config.calibrate_online);
  lidar.path("learned_file", config.learned_file);
  read_mount(lidar.object("mount"), config.mount);
  read_motor(lidar, config.motor);
  lidar.path("file", config.file);
  read_speed(lidar, config.speed);
  lidar.boolean("loop", config.loop);
  lidar.finish();
  if (config.max_range_m <= config.min_range_m) {
    lidar.fail("max_range", "must be more than min_range, " + to_text(config.min_range_m));
  }
  if (config.driver == DriverKind::kReplay && config.file.empty()) {
    lidar.fail("file", "is missing; the driver \"replay\" plays it");
  }
}

void read_odometry_noise(ObjectReader noise, core::OdometryNoise& config) {
  noise.number("wheel", config.wheel_m_per_sqrt_m, {1e-5, 1});
  noise.number("gyro", config.gyro_rad_s_per_sqrt_hz, {1e-6, 1});
  noise.number("wheel_scale", config.wheel_scale, {0, 0.5});
  noise.number("track_scale", config.track_scale, {0, 0.5});
  noise.number("gyro_scale", config.gyro_scale, {0, 0.5});
  noise.number("gyro_bias", config.gyro_bias_rad_s, {0, 1});
  noise.number("gyro_bias_walk", config.bias_rad_s_per_sqrt_s, {0, 0.1});
  noise.number("delay", config.delay_s, {0, 0.1});
  noise.finish();
}

void read_encoder(ObjectReader encoder, KernelOdometryConfig::Encoder& config) {
  encoder.text("counter", config.counter, kMaxDeviceNameBytes);
  encoder.integer("count", config.count, 0, 255);
  encoder.boolean("reversed", config.reversed);
  encoder.finish();
  if (config.counter.empty()) encoder.fail("counter", "must name a counter");
}

void read_kernel_odometry(ObjectReader kernel, KernelOdometryConfig& config) {
  read_encoder(kernel.object("left"), config.left);
  read_encoder(kernel.object("right"), config.right);
  ObjectReader gyro = kernel.object("gyro");
  gyro.text("device", config.gyro.device, kMaxDeviceNameBytes);
  if (config.gyro.device == "none") config.gyro.device.clear();
  gyro.choice("axis", config.gyro.axis, kGyroAxes);
  gyro.boolean("reversed", config.gyro.reversed);
  gyro.finish();
  kernel.number("rate", config.rate_hz, {5, 500});
  kernel.path("sysfs", config.sysfs);
  kernel.finish();
  if (config.left.counter == config.right.counter && config.left.count == config.right.count) {
    kernel.fail("right", "must not be the same as left");
  }
}

void read_odometry(ObjectReader odometry, OdometryConfig& config) {
  odometry.choice("source", config.source, kOdometrySources);
  read_kernel_odometry(odometry.object("kernel"), config.kernel);
  core::DriveGeometry& geometry = config.core.geometry;
  odometry.number("wheel_radius", geometry.wheel_radius_m, {0.001, 10});
  odometry.number("track", geometry.track_m, {0.001, 10});
  odometry.number("counts_per_turn", geometry.counts_per_turn, {1, 1e7});
  odometry.integer("ceiling", geometry.counter_max, std::int64_t{0}, std::int64_t{1} << 53);
  if (geometry.counter_max == 1 || geometry.counter_max == 2) {
    odometry.fail("ceiling",
                  "must be 0 (never wraps) or at least 3: of fewer counts forward and "
                  "back are the same");
  }
  odometry.choice("mode", config.core.mode, kOdometryModes);
  ObjectReader factors = odometry.object("factors");
  factors.number("encoder", config.core.paper.encoder_factor, {0, 10});
  factors.number("gyro", config.core.paper.gyro_factor, {0, 10});
  factors.finish();
  odometry.number("dead_band", config.core.paper.dead_band_rad, {0, 1});
  read_odometry_noise(odometry.object("noise"), config.core.noise);
  ObjectReader start = odometry.object("start");
  start.number("left_scale", config.core.initial.left_scale, {-0.5, 0.5});
  start.number("right_scale", config.core.initial.right_scale, {-0.5, 0.5});
  start.number("track_scale", config.core.initial.track_scale, {-0.5, 0.5});
  start.number("gyro_scale", config.core.initial.gyro_scale, {-0.5, 0.5});
  start.number("gyro_bias", config.core.initial.gyro_bias_rad_s, {-0.5, 0.5});
  start.number("delay", config.core.initial.delay_s, {-kMostStartDelay_s, kMostStartDelay_s});
  start.finish();
  odometry.number("max_speed", config.core.limits.wheel_speed_m_s, {0.01, 100});
  odometry.number("bridge", config.core.max_extrapolation_s, {0, 3600});
  odometry.boolean("publish", config.core.publish_predictions);
  odometry.finish();
  config.core.enabled = config.source != OdometrySource::kNone;
  // The driver goes by each counter's own ceiling.
  if (config.source == OdometrySource::kKernel) geometry.counter_max = 0;
}

void read_socket_path(ObjectReader& socket, std::string_view key, std::filesystem::path& member) {
  constexpr std::size_t kMaxBytes = sizeof(sockaddr_un::sun_path) - 1;
  socket.path(key, member);
  if (member.native().size() > kMaxBytes) {
    socket.fail(key, "a socket's path has at most " + std::to_string(kMaxBytes) +
                         " bytes: " + member.string());
  }
}

void read_sockets(ObjectReader socket, SocketConfig& config) {
  read_socket_path(socket, "pose", config.pose);
  read_socket_path(socket, "control", config.control);
  socket.finish();
  if (config.pose == config.control) socket.fail("control", "must not be the same as pose");
}

void read_realtime(ObjectReader realtime, RealtimeConfig& config) {
  realtime.integer("priority", config.priority, 0, 99);
  realtime.boolean("lock_memory", config.lock_memory);
  realtime.finish();
}

void read_localizer(ObjectReader localizer, LocalizationConfig& config) {
  localizer.choice("recognition", config.recognition, kRecognitions);
  localizer.integer("updates_per_turn", config.updates_per_scan, 1, kMaxUpdatesPerScan);
  localizer.finish();
}

Config read_config(ObjectReader root, bool require_map) {
  Config config;
  read_lidar(root.object("lidar"), config.lidar);
  if (!root.path("map", config.map) && require_map) {
    root.fail("map", "is missing; it is the one key without a default");
  }
  read_detector(root.object("detector"), config.detector);
  read_localizer(root.object("localizer"), config.localization);
  read_odometry(root.object("odometry"), config.odometry);
  read_sockets(root.object("socket"), config.socket);
  read_realtime(root.object("realtime"), config.realtime);
  root.finish();
  return config;
}

}  // namespace

core::LocalizerConfig Config::localizer() const {
  core::LocalizerConfig config;
  config.min_range_m = lidar.min_range_m;
  config.max_range_m = lidar.max_range_m;
  config.T_base_lidar = {lidar.mount.x_m, lidar.mount.y_m,
                         core::normalize_angle(lidar.mount.theta_rad)};
  config.detector = detector;
  config.recognition = localization.recognition;
  config.updates_per_scan = static_cast<std::size_t>(localization.updates_per_scan);
  config.noise = lidar.noise.sensor;
  config.bias = lidar.bias;
  config.calibrate_online = lidar.calibrate_online;
  config.odometry = odometry.core;
  return config;
}

Config parse_config(std::string_view text, const std::filesystem::path& file,
                    const std::vector<std::string>& overrides, bool require_map) {
  DocumentContext context{.file = file};
  if (!file.empty()) context.folder = std::filesystem::absolute(file).parent_path();
  Json document = parse_document(text, file);
  for (const std::string& override_text : overrides) {
    context.overridden.insert(apply_override(document, override_text));
  }
  return read_config({context, document, ""}, require_map);
}

Config load_config(const std::filesystem::path& file, const std::vector<std::string>& overrides,
                   FileKind kind) {
  return parse_config(read_file(file, kMaxConfigBytes, kind), file, overrides);
}

}  // namespace cornerd::settings
