// SPDX-License-Identifier: MIT
#include "settings/config_warnings.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace cornerd::settings {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

TEST(ConfigWarnings, MountInCentimetres_IsNamed) {
  Config config;
  EXPECT_THAT(warnings_of(config), IsEmpty());
  config.lidar.mount.x_m = 4;
  EXPECT_THAT(warnings_of(config), ElementsAre(HasSubstr("metres")));
}

}  // namespace
}  // namespace cornerd::settings
