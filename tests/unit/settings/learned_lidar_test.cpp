// SPDX-License-Identifier: MIT
#include "settings/learned_lidar.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "error_of.hpp"

namespace cornerd::settings {
namespace {

using ::testing::HasSubstr;

LearnedLidar usual_lidar() {
  LearnedLidar lidar;
  lidar.serial = "9D38E1C3";
  lidar.configured.range_offset_m = 0.002;
  lidar.learned = {{0.0098, 0.0051, 0.0036, -0.0034}, {4e-4, 5e-4, 2e-4, 2e-4}, 412};
  return lidar;
}

std::string learned_error(const std::string& text) {
  return error_of([&] { parse_learned_lidar(text, "l.json"); });
}

TEST(LearnedLidar, Written_ReadsTheSame) {
  const LearnedLidar lidar = usual_lidar();
  const LearnedLidar again = parse_learned_lidar(text_of(lidar), "l.json");
  EXPECT_EQ(again.serial, lidar.serial);
  EXPECT_EQ(again.configured, lidar.configured);
  EXPECT_EQ(again.learned.bias, lidar.learned.bias);
  EXPECT_EQ(again.learned.sigma, lidar.learned.sigma);
  EXPECT_EQ(again.learned.scans, 412u);
}

TEST(LearnedLidar, WithoutANumber_ReadsTheSame) {
  LearnedLidar lidar = usual_lidar();
  lidar.serial.clear();
  EXPECT_EQ(parse_learned_lidar(text_of(lidar), "l.json").serial, "");
}

TEST(LearnedLidar, CutShort_IsAnError) {
  const std::string text = text_of(usual_lidar());
  for (std::size_t length = 0; length + 2 < text.size(); length += 7) {
    EXPECT_THAT(learned_error(text.substr(0, length)), HasSubstr("l.json")) << length;
  }
}

TEST(LearnedLidar, OfAnotherKindOrWithoutWhatItNeeds_IsAnError) {
  EXPECT_THAT(learned_error("{}"), HasSubstr("/format"));
  EXPECT_THAT(learned_error(R"({"format":"cornerd-map"})"), HasSubstr("/format"));
  EXPECT_THAT(learned_error(R"({"format":"cornerd-lidar","turns":3})"), HasSubstr("/sigma"));
  LearnedLidar lidar = usual_lidar();
  lidar.learned.scans = 0;
  EXPECT_THAT(learned_error(text_of(lidar)), HasSubstr("/turns"));
  lidar = usual_lidar();
  lidar.learned.bias.range_scale = 0.2;
  EXPECT_THAT(learned_error(text_of(lidar)), HasSubstr("/bias/range_scale"));
  lidar = usual_lidar();
  for (const double sigma : {-1e-4, 0.0, 1e-200}) {
    lidar.learned.sigma.bearing_cosine_rad = sigma;
    EXPECT_THAT(learned_error(text_of(lidar)), HasSubstr("/sigma")) << sigma;
  }
}

}  // namespace
}  // namespace cornerd::settings
