// SPDX-License-Identifier: MIT
// The samples in config/ are documentation that is read by the program: they must be true.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <regex>
#include <string>

#include "error_of.hpp"
#include "settings/document.hpp"

namespace cornerd::settings {
namespace {

const std::filesystem::path kSamples = std::filesystem::path(CORNERD_SOURCE_DIR) / "config";

Json full_sample() {
  const auto file = kSamples / "cornerd.full.json";
  return parse_document(read_file(file, 1 << 20), file);
}

/// The keys that the program knows in an object, by its own word.
std::string known_keys(const std::string& object_pointer) {
  const std::string unknown = object_pointer + "/zzzzzzzzzzzz=1";
  return error_of([&] { parse_config(R"({"map": "/m"})", "", {unknown}); });
}

void expect_all_known_keys_in(const Json& object, const std::string& pointer,
                              const std::string& comments) {
  const std::string message = known_keys(pointer);
  const std::regex word("[a-z_]+");
  const std::string list = message.substr(message.find("known here: ") + 12);
  for (auto key = std::sregex_iterator(list.begin(), list.end(), word);
       key != std::sregex_iterator(); ++key) {
    const std::string name = key->str();
    EXPECT_TRUE(object.contains(name) || comments.find("// \"" + name + "\":") != std::string::npos)
        << "config/cornerd.full.json lacks " << pointer << "/" << name;
  }
}

TEST(FullSample, EveryKeyTheProgramKnows_IsThere) {
  const Json sample = full_sample();
  const std::string text = read_file(kSamples / "cornerd.full.json", 1 << 20);
  expect_all_known_keys_in(sample, "", text);
  for (const char* section : {"lidar", "detector", "localizer", "odometry", "socket", "realtime"}) {
    expect_all_known_keys_in(sample[section], std::string("/") + section, text);
  }
  expect_all_known_keys_in(sample["lidar"]["mount"], "/lidar/mount", text);
  expect_all_known_keys_in(sample["lidar"]["noise"], "/lidar/noise", text);
  expect_all_known_keys_in(sample["lidar"]["bias"], "/lidar/bias", text);
  for (const char* section : {"altbd", "printed_altbd", "abd_iepf", "lt", "extraction"}) {
    expect_all_known_keys_in(sample["detector"][section], std::string("/detector/") + section,
                             text);
  }
}

void expect_default_detector(const core::DetectorConfig& sample) {
  const core::DetectorConfig defaults;
  constexpr double kRounding = 1e-5;  // of angles, in the file
  EXPECT_EQ(sample.method, defaults.method);
  EXPECT_EQ(sample.sigma_offset, defaults.sigma_offset);
  EXPECT_EQ(sample.corner_tolerance_m, defaults.corner_tolerance_m);
  EXPECT_EQ(sample.min_support, defaults.min_support);
  EXPECT_EQ(sample.altbd.gate_sigmas, defaults.altbd.gate_sigmas);
  EXPECT_EQ(sample.altbd.seed_samples, defaults.altbd.seed_samples);
  EXPECT_EQ(sample.altbd.misses_to_break, defaults.altbd.misses_to_break);
  EXPECT_NEAR(sample.altbd.max_gap_rad, defaults.altbd.max_gap_rad, kRounding);
  EXPECT_EQ(sample.altbd.max_gap_m, defaults.altbd.max_gap_m);
  EXPECT_EQ(sample.altbd.prior_residuals, defaults.altbd.prior_residuals);
  EXPECT_EQ(sample.printed_altbd.axes, defaults.printed_altbd.axes);
  EXPECT_EQ(sample.printed_altbd.minor, defaults.printed_altbd.minor);
  EXPECT_EQ(sample.printed_altbd.line, defaults.printed_altbd.line);
  EXPECT_EQ(sample.printed_altbd.mean, defaults.printed_altbd.mean);
  EXPECT_EQ(sample.abd_iepf.threshold, defaults.abd_iepf.threshold);
  EXPECT_EQ(sample.abd_iepf.sigma_r, defaults.abd_iepf.sigma_r);
  EXPECT_NEAR(sample.abd_iepf.lambda_rad, defaults.abd_iepf.lambda_rad, kRounding);
  EXPECT_EQ(sample.abd_iepf.split_limit_m, defaults.abd_iepf.split_limit_m);
  EXPECT_EQ(sample.lt.max_distance_m, defaults.lt.max_distance_m);
  EXPECT_EQ(sample.extraction.gate_sigmas, defaults.extraction.gate_sigmas);
  EXPECT_EQ(sample.extraction.max_interruption, defaults.extraction.max_interruption);
  EXPECT_EQ(sample.extraction.max_piece_gap_m, defaults.extraction.max_piece_gap_m);
  EXPECT_NEAR(sample.extraction.max_piece_angle_rad, defaults.extraction.max_piece_angle_rad,
              kRounding);
  EXPECT_EQ(sample.extraction.joined_chi_square, defaults.extraction.joined_chi_square);
  EXPECT_EQ(sample.extraction.short_wall_samples, defaults.extraction.short_wall_samples);
  EXPECT_NEAR(sample.extraction.short_wall_sigma_rad, defaults.extraction.short_wall_sigma_rad,
              kRounding);
  EXPECT_NEAR(sample.extraction.min_corner_angle_rad, defaults.extraction.min_corner_angle_rad,
              kRounding);
  EXPECT_EQ(sample.extraction.grazing_rays, defaults.extraction.grazing_rays);
  EXPECT_EQ(sample.extraction.grazing_reach, defaults.extraction.grazing_reach);
  EXPECT_EQ(sample.extraction.see_through_samples, defaults.extraction.see_through_samples);
  EXPECT_EQ(sample.extraction.see_through_gap_m, defaults.extraction.see_through_gap_m);
  EXPECT_EQ(sample.extraction.max_face_m, defaults.extraction.max_face_m);
  EXPECT_EQ(sample.extraction.min_face_samples, defaults.extraction.min_face_samples);
  EXPECT_EQ(sample.extraction.samples_beyond, defaults.extraction.samples_beyond);
  EXPECT_EQ(sample.extraction.max_end_span_m, defaults.extraction.max_end_span_m);
  EXPECT_NEAR(sample.extraction.max_rest_sigma_rad, defaults.extraction.max_rest_sigma_rad,
              kRounding);
  EXPECT_NEAR(sample.extraction.min_rest_angle_rad, defaults.extraction.min_rest_angle_rad,
              kRounding);
  EXPECT_EQ(sample.extraction.max_rest_corner_sigma_m, defaults.extraction.max_rest_corner_sigma_m);
}

void expect_default_odometry(const OdometryConfig& sample, const OdometryConfig& defaults) {
  EXPECT_EQ(sample.source, defaults.source);
  EXPECT_EQ(sample.core.enabled, defaults.core.enabled);
  const core::DriveGeometry& geometry = sample.core.geometry;
  EXPECT_EQ(geometry.wheel_radius_m, defaults.core.geometry.wheel_radius_m);
  EXPECT_EQ(geometry.track_m, defaults.core.geometry.track_m);
  EXPECT_EQ(geometry.counts_per_turn, defaults.core.geometry.counts_per_turn);
  EXPECT_EQ(geometry.counter_max, defaults.core.geometry.counter_max);
  EXPECT_EQ(sample.core.mode, defaults.core.mode);
  EXPECT_EQ(sample.core.paper.encoder_factor, defaults.core.paper.encoder_factor);
  EXPECT_EQ(sample.core.paper.gyro_factor, defaults.core.paper.gyro_factor);
  EXPECT_EQ(sample.core.paper.dead_band_rad, defaults.core.paper.dead_band_rad);
  const core::OdometryNoise& noise = sample.core.noise;
  EXPECT_EQ(noise.wheel_m_per_sqrt_m, defaults.core.noise.wheel_m_per_sqrt_m);
  EXPECT_EQ(noise.gyro_rad_s_per_sqrt_hz, defaults.core.noise.gyro_rad_s_per_sqrt_hz);
  EXPECT_EQ(noise.wheel_scale, defaults.core.noise.wheel_scale);
  EXPECT_EQ(noise.track_scale, defaults.core.noise.track_scale);
  EXPECT_EQ(noise.gyro_scale, defaults.core.noise.gyro_scale);
  EXPECT_EQ(noise.gyro_bias_rad_s, defaults.core.noise.gyro_bias_rad_s);
  EXPECT_EQ(noise.bias_rad_s_per_sqrt_s, defaults.core.noise.bias_rad_s_per_sqrt_s);
  EXPECT_EQ(noise.delay_s, defaults.core.noise.delay_s);
  EXPECT_EQ(sample.core.limits.wheel_speed_m_s, defaults.core.limits.wheel_speed_m_s);
  const core::OdometryParameters& start = sample.core.initial;
  EXPECT_EQ(start.left_scale, defaults.core.initial.left_scale);
  EXPECT_EQ(start.right_scale, defaults.core.initial.right_scale);
  EXPECT_EQ(start.track_scale, defaults.core.initial.track_scale);
  EXPECT_EQ(start.gyro_scale, defaults.core.initial.gyro_scale);
  EXPECT_EQ(start.gyro_bias_rad_s, defaults.core.initial.gyro_bias_rad_s);
  EXPECT_EQ(start.delay_s, defaults.core.initial.delay_s);
  EXPECT_EQ(sample.core.max_extrapolation_s, defaults.core.max_extrapolation_s);
}

TEST(FullSample, EveryValue_IsTheDefault) {
  const Config sample = load_config(kSamples / "cornerd.full.json");
  const Config defaults;
  EXPECT_EQ(sample.lidar.driver, defaults.lidar.driver);
  EXPECT_EQ(sample.lidar.device, defaults.lidar.device);
  EXPECT_EQ(sample.lidar.baud, defaults.lidar.baud);
  EXPECT_EQ(sample.lidar.mode, defaults.lidar.mode);
  EXPECT_EQ(sample.lidar.min_range_m, defaults.lidar.min_range_m);
  EXPECT_EQ(sample.lidar.max_range_m, defaults.lidar.max_range_m);
  EXPECT_EQ(sample.lidar.noise.sensor.floor_m, defaults.lidar.noise.sensor.floor_m);
  EXPECT_EQ(sample.lidar.noise.sensor.share, defaults.lidar.noise.sensor.share);
  EXPECT_NEAR(sample.lidar.noise.sensor.bearing_rad, defaults.lidar.noise.sensor.bearing_rad, 1e-6);
  EXPECT_TRUE(sample.lidar.noise.sensor.table.empty());
  EXPECT_TRUE(sample.lidar.noise.wall.empty());
  EXPECT_TRUE(sample.lidar.bias.is_none());
  EXPECT_EQ(sample.lidar.calibrate_online, defaults.lidar.calibrate_online);
  EXPECT_EQ(sample.lidar.mount.x_m, defaults.lidar.mount.x_m);
  EXPECT_EQ(sample.lidar.mount.y_m, defaults.lidar.mount.y_m);
  EXPECT_EQ(sample.lidar.mount.theta_rad, defaults.lidar.mount.theta_rad);
  EXPECT_EQ(sample.lidar.mount.inverted, defaults.lidar.mount.inverted);
  EXPECT_EQ(sample.lidar.motor.kind, defaults.lidar.motor.kind);
  EXPECT_EQ(sample.lidar.speed, defaults.lidar.speed);
  EXPECT_EQ(sample.lidar.loop, defaults.lidar.loop);
  expect_default_detector(sample.detector);
  expect_default_odometry(sample.odometry, defaults.odometry);
  EXPECT_EQ(sample.socket.pose, defaults.socket.pose);
  EXPECT_EQ(sample.socket.control, defaults.socket.control);
  EXPECT_EQ(sample.realtime.priority, defaults.realtime.priority);
  EXPECT_EQ(sample.realtime.lock_memory, defaults.realtime.lock_memory);
}

TEST(SampleRobots, BothOfThem_AreRead) {
  for (const char* name : {"pioneer-p3dx", "contest-16cm"}) {
    const std::filesystem::path file =
        std::string(CORNERD_SOURCE_DIR "/config/robots/") + name + ".json";
    std::ifstream stream(file);
    const std::string text(std::istreambuf_iterator<char>(stream), {});
    const Config config = parse_config(text, file, {}, /*require_map=*/false);
    EXPECT_TRUE(config.odometry.core.enabled) << name;
    EXPECT_GT(config.odometry.core.geometry.track_m, 0.1) << name;
  }
}

TEST(FullSample, MotorsInItsComments_AreRead) {
  const std::string text = read_file(kSamples / "cornerd.full.json", 1 << 20);
  const std::regex example(R"(//\s+(\{ "kind".*\}))");
  int examples = 0;
  for (auto match = std::sregex_iterator(text.begin(), text.end(), example);
       match != std::sregex_iterator(); ++match, ++examples) {
    EXPECT_NO_THROW(
        parse_config(R"({"map": "/m", "lidar": {"motor": )" + (*match)[1].str() + "}}", "sample"));
  }
  EXPECT_EQ(examples, 2);
}

TEST(SmallSample, Always_IsRead) { EXPECT_NO_THROW(load_config(kSamples / "cornerd.json")); }

}  // namespace
}  // namespace cornerd::settings
