// SPDX-License-Identifier: MIT
#include "settings/noise.hpp"

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
  EXPECT_EQ(noise.floor_m, core::SensorNoise{}.floor_m);
  EXPECT_EQ(noise.share, core::SensorNoise{}.share);
  EXPECT_EQ(noise.bearing_rad, core::SensorNoise{}.bearing_rad);
  EXPECT_TRUE(noise.table.empty());
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

TEST(Noise, WrongValues_AreNamedByTheirPointer) {
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

TEST(Noise, MoreRangesThanTheTableHolds_AreAnError) {
  std::string list;
  for (int i = 0; i < 65; ++i) {
    list += (i > 0 ? ", " : "") + ("{\"range\": " + std::to_string(i + 1)) + ", \"sigma\": 0.1}";
  }
  EXPECT_THAT(noise_error("{\"ranges\": [" + list + "]}"),
              EndsWith("/lidar/noise/ranges: has more than 64 entries"));
}

}  // namespace
}  // namespace cornerd::settings
