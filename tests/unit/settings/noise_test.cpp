// SPDX-License-Identifier: MIT

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "error_of.hpp"
#include "settings/config.hpp"

namespace cornerd::settings {
namespace {

using ::testing::EndsWith;
using ::testing::HasSubstr;

Config parse_noise(const std::string& noise) {
  return parse_config(R"({"map": "/m", "lidar": {"noise": )" + noise + "}}", "n.json");
}
std::string noise_error(const std::string& noise) {
  return error_of([&] { parse_noise(noise); });
}

TEST(Noise, Absent_IsTheDefault) {
  const core::SensorNoise noise = parse_noise("{}").localizer().noise;
  EXPECT_TRUE(parse_noise("{}").lidar.noise.wall.empty());
  EXPECT_EQ(noise.floor_m, core::SensorNoise{}.floor_m);
  EXPECT_EQ(noise.share, core::SensorNoise{}.share);
  EXPECT_EQ(noise.bearing_rad, core::SensorNoise{}.bearing_rad);
  EXPECT_TRUE(noise.table.empty());
}

TEST(Noise, AbsentKey_IsTheModels) {
  const drivers::LidarModel& model = *drivers::find_lidar_model("s2");
  const core::SensorNoise noise =
      parse_config(R"({"map": "/m", "lidar": {"noise": {"share": 0.02}}})", "n.json", {}, true,
                   &model)
          .localizer()
          .noise;
  EXPECT_EQ(noise.floor_m, model.noise_floor_m);
  EXPECT_EQ(noise.share, 0.02);
  EXPECT_EQ(noise.bearing_rad, model.noise_bearing_rad);
  const core::SensorNoise of_driver =
      parse_config(R"({"map": "/m", "lidar": {"driver": "ld"}})", "n.json", {}, true, &model)
          .localizer()
          .noise;
  EXPECT_EQ(of_driver.bearing_rad, drivers::find_lidar_model("ld06")->noise_bearing_rad)
      << "the model is another driver's";
}

TEST(Noise, EveryKey_ReachesTheLocalizer) {
  const core::SensorNoise noise = parse_noise(R"({"floor": 0.002, "share": 0.01, "bearing": 0.003,
      "ranges": [{"range": 0.5, "sigma": 0.001}, {"range": 2, "sigma": 0.004}]})")
                                      .localizer()
                                      .noise;
  EXPECT_EQ(noise.floor_m, 0.002);
  EXPECT_EQ(noise.share, 0.01);
  EXPECT_EQ(noise.bearing_rad, 0.003);
  EXPECT_NEAR(noise.sigma_range_m(1.25), 0.0025, 1e-9);
}

TEST(Noise, WrongValue_IsNamedByItsPointer) {
  EXPECT_THAT(noise_error(R"({"floor": 0})"), HasSubstr("/lidar/noise/floor: must be from"));
  EXPECT_THAT(noise_error(R"({"share": -1})"), HasSubstr("/lidar/noise/share: must be from"));
  EXPECT_THAT(noise_error(R"({"bearing": 5})"), HasSubstr("/lidar/noise/bearing: must be from"));
  EXPECT_THAT(noise_error(R"({"sigma": 1})"), HasSubstr("/lidar/noise/sigma: unknown key"));
  EXPECT_THAT(noise_error("3"), HasSubstr("/lidar/noise: must be an object"));
  EXPECT_THAT(noise_error(R"({"ranges": 3})"), HasSubstr("/lidar/noise/ranges: must be a list"));
  EXPECT_THAT(noise_error(R"({"ranges": [{"range": 1, "sigma": 0}]})"),
              HasSubstr("/lidar/noise/ranges/0/sigma: must be from"));
  EXPECT_THAT(noise_error(R"({"ranges": [{"range": 1}]})"),
              EndsWith("/lidar/noise/ranges/0/sigma: is missing"));
  EXPECT_THAT(noise_error(R"({"ranges": [{"sigma": 1}]})"),
              EndsWith("/lidar/noise/ranges/0/range: is missing"));
  EXPECT_THAT(noise_error(R"({"ranges": [7]})"),
              EndsWith("/lidar/noise/ranges/0: must be an object"));
  EXPECT_THAT(noise_error(R"({"ranges": [{"range": 1, "sigma": 0.1, "n": 2}]})"),
              HasSubstr("/lidar/noise/ranges/0/n: unknown key"));
  EXPECT_THAT(
      noise_error(R"({"ranges": [{"range": 1, "sigma": 0.1}, {"range": 1, "sigma": 0.1}]})"),
      HasSubstr("/lidar/noise/ranges/1: must be of a longer range"));
}

TEST(Noise, WallModel_IsRead) {
  const calibration::WallModel wall = parse_noise(R"({"wall": [
      {"from": 0.2, "to": 0.6, "ray": 1, "sigma": 0.002, "coefficients": [[0.001, 0.01], [0.003]]},
      {"from": 0.6, "to": 1, "ray": 1, "sigma": 0.003, "coefficients": []}]})")
                                          .lidar.noise.wall;
  EXPECT_NEAR(wall.error_m(0.5, 0.1), 0.001 + 0.005 + 0.0003, 1e-12);
  EXPECT_EQ(wall.error_m(0.8, 0.1), 0);
  EXPECT_EQ(wall.sigma_m(0.8), 0.003);
}

TEST(Noise, WrongWallModel_IsNamedByItsPointer) {
  const auto piece_error = [](const std::string& coefficients, const std::string& to = "1") {
    return noise_error(R"({"wall": [{"from": 0.2, "ray": 1, "sigma": 0.002, "to": )" + to +
                       R"(, "coefficients": )" + coefficients + "}]}");
  };
  EXPECT_THAT(noise_error(R"({"wall": {}})"), HasSubstr("/lidar/noise/wall: must be a list"));
  EXPECT_THAT(noise_error(R"({"wall": [{}]})"), EndsWith("/lidar/noise/wall/0/from: is missing"));
  EXPECT_THAT(piece_error("[]", "0.1"), HasSubstr("/wall/0/to: must not be less than from"));
  EXPECT_THAT(piece_error("7"), HasSubstr("/wall/0/coefficients: must be a list of at most 7"));
  EXPECT_THAT(piece_error("[[],[],[],[],[],[],[],[]]"), HasSubstr("/wall/0/coefficients: must"));
  EXPECT_THAT(piece_error("[[0], [1, 2, 3, 4, 5]]"),
              HasSubstr("/wall/0/coefficients/1: must be a list of at most 4"));
  EXPECT_THAT(piece_error("[[0], [\"x\"]]"), HasSubstr("/wall/0/coefficients/1: must hold"));
  EXPECT_THAT(piece_error("[[1e9]]"), HasSubstr("/wall/0/coefficients/0: must hold numbers"));
}

TEST(Noise, TooManyRanges_AreAnError) {
  std::string list;
  for (int i = 0; i < 65; ++i) {
    list += (i > 0 ? ", " : "") + ("{\"range\": " + std::to_string(i + 1)) + ", \"sigma\": 0.1}";
  }
  EXPECT_THAT(noise_error("{\"ranges\": [" + list + "]}"),
              EndsWith("/lidar/noise/ranges: has more than 64 entries"));
}

}  // namespace
}  // namespace cornerd::settings
